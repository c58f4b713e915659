// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav {

/// Action and arguments of `urban_nav edge STORE`, as sent by the page.
struct EditWords {
  std::string action;
  std::vector<std::string> arguments;
  std::map<std::string, std::string> options;  ///< without dashes: "pose"

  /// Returns them as a command line.
  std::string print() const;
};

/// Reads {"action": "assert", "arguments": ["T1", "T2"], "options": {"pose": "..."}} ("options" may be absent). Throws
/// UserError for other content, for an unknown action, and for words that are too long or have control characters. The
/// meaning of the words is not checked here.
EditWords parseEditWords(std::string_view json);

}  // namespace urban_nav
