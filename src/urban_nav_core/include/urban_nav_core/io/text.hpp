// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_core {

/// Returns the words with ", " between them; empty for no words.
std::string joined(const std::vector<std::string>& words);

/// Returns whether the last characters of `text` are those of `end`.
bool endsWith(std::string_view text, std::string_view end);

/// Returns whether `a` comes before `b` in name order with the numbers in them by value: 2 before 10, 02 before 2.
bool isNaturallyLess(std::string_view a, std::string_view b);

}  // namespace urban_nav_core
