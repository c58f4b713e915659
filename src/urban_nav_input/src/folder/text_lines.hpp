// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_input {

struct TextLine {
  int number = 0;  ///< from 1
  std::string text;
};

/// Returns the lines of a small text file that are neither blank nor begin with '#' or '%'. Throws the errors of
/// readTextFile().
std::vector<TextLine> readLines(const std::string& path);

}  // namespace urban_nav_input
