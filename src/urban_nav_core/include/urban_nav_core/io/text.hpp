// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_core {

/// Returns the words separated by ", "; empty for no words.
std::string joined(const std::vector<std::string>& words);

/// Returns whether `text` ends with `end`.
bool endsWith(std::string_view text, std::string_view end);

/// Returns whether `a` comes before `b` in natural order, with numbers compared by value: 2 before 10, 02 before 2.
bool isNaturallyLess(std::string_view a, std::string_view b);

}  // namespace urban_nav_core
