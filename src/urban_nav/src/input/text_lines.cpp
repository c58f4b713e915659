// SPDX-License-Identifier: BSD-3-Clause
#include "input/text_lines.hpp"

#include <fstream>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

std::vector<TextLine> readLines(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw urban_nav_core::UserError(path, "does not open", "a text file");
  std::vector<TextLine> lines;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::string_view text = urban_nav_core::trimmed(line);
    if (!text.empty() && text.front() != '#' && text.front() != '%') lines.push_back({number, std::string(text)});
  }
  return lines;
}

}  // namespace urban_nav
