// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace urban_nav {

/// A time given by the user: seconds since 1970 ("1225719873.5"), or since the start of a session ("+12.5",
/// "quad+12.5").
struct TimeQuery {
  std::string session;  ///< name or beginning of an id; empty: any
  bool since_begin = false;
  double seconds = 0.0;
  std::int64_t stamp = 0;  ///< ns, unless since_begin
};

/// Throws UserError naming `what` if the text is invalid.
TimeQuery parseTimeQuery(const std::string& text, const std::string& what);

}  // namespace urban_nav
