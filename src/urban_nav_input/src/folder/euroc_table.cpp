// SPDX-License-Identifier: BSD-3-Clause
#include "folder/euroc_table.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "urban_nav_core/io/column_names.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/text_table.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

using urban_nav_core::UserError;

namespace {

constexpr double kLargestSeconds = 1e11;  // a stamp in s is smaller, in ns larger than 1e17 since 1973

/// Returns the unit of stamps in s: seconds if they have decimals and the size of seconds, else that of the header,
/// else ns.
double guessUnitOfAll(const std::vector<std::string>& header, const std::vector<EurocRow>& rows) {
  double largest = 0.0;
  bool has_decimals = false;
  for (const EurocRow& row : rows) {
    largest = std::max(largest, std::abs(urban_nav_core::parseNumber(row.cells.front()).value_or(0.0)));
    has_decimals = has_decimals || row.cells.front().find('.') != std::string::npos;
  }
  if (has_decimals && largest < kLargestSeconds) return 1.0;  // for any header of the EuRoC format
  return header.empty() ? 1e-9 : urban_nav_core::readUnit(header.front()).value_or(1e-9);
}

/// Returns a stamp in ns; nullopt for other text.
std::optional<urban_nav_core::StampNs> parseStampIn(double unit, const std::string& text) {
  if (unit == 1.0) return urban_nav_core::parseTime(text);
  if (unit == 1e-9)
    if (const auto whole = urban_nav_core::parseInteger(text)) return whole;
  const auto number = urban_nav_core::parseNumber(text);
  if (!number || std::abs(unit * *number) > 9.2e9) return std::nullopt;
  return static_cast<urban_nav_core::StampNs>(std::llround(unit * 1e9 * *number));
}

}  // namespace

double EurocRow::number(std::size_t cell) const {
  const auto value = urban_nav_core::parseNumber(cells[cell]);
  if (!value) throw UserError(where, "`" + cells[cell] + "`", "a finite number");
  return *value;
}

EurocTable readEurocTable(const std::string& path, std::size_t columns, const std::string& meaning) {
  EurocTable table;
  std::vector<EurocRow> rows;
  const std::string text = urban_nav_core::readTextFile(path);
  const urban_nav_core::TextTable lines(text, path);
  bool has_header = false;
  lines.forEachRow([&](const urban_nav_core::TableRow& line) {
    EurocRow row;
    row.where = lines.where(line);
    row.cells.assign(line.cells.begin(), line.cells.end());
    const bool is_header = !urban_nav_core::parseNumber(row.cells.front()) && rows.empty() && lines.header().empty();
    if (is_header && !std::exchange(has_header, true)) return;  // its width may differ from that of the rows
    rows.push_back(std::move(row));
  });
  table.unit = guessUnitOfAll(lines.header(), rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EurocRow& row = rows[i];
    const auto stamp = parseStampIn(table.unit, row.cells.front());
    if (!stamp)
      throw UserError(row.where, "stamp `" + row.cells.front() + "`",
                      table.unit == 1.0 ? "seconds, as in other rows" : "a whole number of ns");
    if (row.cells.size() < columns) throw UserError(row.where, std::to_string(row.cells.size()) + " columns", meaning);
    row.stamp = *stamp;
    if (i > 0 && row.stamp < rows[i - 1].stamp) ++table.out_of_order;
  }
  std::stable_sort(rows.begin(), rows.end(), [](const EurocRow& a, const EurocRow& b) { return a.stamp < b.stamp; });
  for (EurocRow& row : rows) {
    if (!table.rows.empty() && table.rows.back().stamp == row.stamp) ++table.repeated;
    else table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace urban_nav_input
