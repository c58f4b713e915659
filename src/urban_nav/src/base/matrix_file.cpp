// SPDX-License-Identifier: BSD-3-Clause
#include "base/matrix_file.hpp"

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/text_table.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

std::vector<double> readMatrixFile(const std::string& path) {
  const std::string text = urban_nav_core::readTextFile(path);
  const urban_nav_core::TextTable table(text, path);
  if (!table.header().empty() && !table.headerIsComment())
    throw urban_nav_core::UserError(table.whereHeader(), urban_nav_core::quotedCell(table.header().front()),
                                    "a finite number");
  std::vector<double> numbers;
  table.forEachRow([&](const urban_nav_core::TableRow& row) {
    for (const std::string_view cell : row.cells) {
      const auto number = urban_nav_core::parseNumber(cell);
      if (!number)
        throw urban_nav_core::UserError(table.where(row), urban_nav_core::quotedCell(cell), "a finite number");
      numbers.push_back(*number);
    }
  });
  return numbers;
}

}  // namespace urban_nav
