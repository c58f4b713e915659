// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav {

/// The words of `urban_nav edge STORE` but for STORE, as a page sends them.
struct EditWords {
  std::string action;
  std::vector<std::string> arguments;
  std::map<std::string, std::string> options;  ///< without dashes: "pose"

  /// Returns the words as a line for a person.
  std::string print() const;
};

/// Reads {"action": "assert", "arguments": ["T1", "T2"], "options": {"pose": "..."}} ("options" may be absent). Throws
/// UserError for anything else, for an action that `edge` has not, and for words that are too long or hold control
/// characters. What the words mean is not checked here.
EditWords parseEditWords(std::string_view json);

}  // namespace urban_nav
