// SPDX-License-Identifier: BSD-3-Clause
#include "folder/euroc_table.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

using urban_nav_core::UserError;

double EurocRow::number(std::size_t cell) const {
  const auto value = urban_nav_core::parseNumber(cells[cell]);
  if (!value) throw UserError(where, "`" + cells[cell] + "`", "a finite number");
  return *value;
}

EurocTable readEurocTable(const std::string& path, std::size_t columns, const std::string& meaning) {
  EurocTable table;
  std::vector<EurocRow> rows;
  bool header_allowed = true;
  urban_nav_core::forEachLine(urban_nav_core::readTextFile(path), [&](std::string_view line, int number) {
    const std::string_view text = urban_nav_core::trimmed(line);
    if (text.empty() || text.front() == '#') return;
    EurocRow row;
    row.where = urban_nav_core::atLine(path, number);
    for (const std::string_view cell : urban_nav_core::splitAt(text, ','))
      row.cells.emplace_back(urban_nav_core::trimmed(cell));
    const auto stamp = urban_nav_core::parseInteger(row.cells.front());
    if (!stamp && std::exchange(header_allowed, false)) return;
    if (!stamp) throw UserError(row.where, "stamp `" + row.cells.front() + "`", "a whole number of ns");
    if (row.cells.size() < columns) throw UserError(row.where, std::to_string(row.cells.size()) + " columns", meaning);
    header_allowed = false;
    row.stamp = *stamp;
    if (!rows.empty() && row.stamp < rows.back().stamp) ++table.out_of_order;
    rows.push_back(std::move(row));
  });
  std::stable_sort(rows.begin(), rows.end(), [](const EurocRow& a, const EurocRow& b) { return a.stamp < b.stamp; });
  for (EurocRow& row : rows) {
    if (!table.rows.empty() && table.rows.back().stamp == row.stamp) ++table.repeated;
    else table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace urban_nav_input
