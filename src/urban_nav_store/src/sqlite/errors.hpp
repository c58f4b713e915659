// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_store {

/// Throws what an SQLite result code (extended or not) means to the person who can act: UserError for a mistake in the
/// call (a place that cannot be written, a file in use), DataError for what the file or the disk did. `system_error`:
/// errno of the call that failed, 0 if none did; `message`: SQLite's own words, for what has none here.
[[noreturn]] void throwError(const std::string& file, int code, int system_error, const std::string& message);

[[noreturn]] void throwDamaged(const std::string& file, const std::string& what);
[[noreturn]] void throwClosed(const std::string& file);
[[noreturn]] void throwReadOnly(const std::string& file);

}  // namespace urban_nav_store
