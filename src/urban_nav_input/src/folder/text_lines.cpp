// SPDX-License-Identifier: BSD-3-Clause
#include "folder/text_lines.hpp"

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"

namespace urban_nav_input {

std::vector<TextLine> readLines(const std::string& path) {
  std::vector<TextLine> lines;
  urban_nav_core::forEachLine(urban_nav_core::readTextFile(path), [&](std::string_view line, int number) {
    const std::string_view text = urban_nav_core::trimmed(line);
    if (!text.empty() && text.front() != '#' && text.front() != '%') lines.push_back({number, std::string(text)});
  });
  return lines;
}

}  // namespace urban_nav_input
