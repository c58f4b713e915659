// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/csv.hpp"

#include <algorithm>

#include "urban_nav_core/io/column_names.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/text_table.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
CsvTable CsvTable::read(const std::string& path) { return parse(readTextFile(path), path); }

CsvTable CsvTable::parse(std::string_view text, const std::string& name) {
  CsvTable table;
  table.name_ = name;
  TextTable rows(text, name);
  rows.requireHeader();
  table.header_ = rows.header();
  if (table.header_.empty()) throw UserError(name, "is empty", "a header line and rows");
  rows.forEachRow([&](const TableRow& row) {
    if (row.cells.size() != table.header_.size())
      throw UserError(rows.where(row), std::to_string(row.cells.size()) + " cells",
                      std::to_string(table.header_.size()) + ", as in the header");
    table.cells_.insert(table.cells_.end(), row.cells.begin(), row.cells.end());
    table.lines_.push_back(row.line);
  });
  return table;
}

std::optional<std::size_t> CsvTable::find(std::string_view name) const {
  auto found = std::find(header_.begin(), header_.end(), name);
  if (found == header_.end())
    found = std::find_if(header_.begin(), header_.end(),
                         [&](const std::string& each) { return plainName(each) == plainName(name); });
  if (found == header_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header_.begin());
}

bool CsvTable::has(std::string_view column) const { return find(column).has_value(); }

std::size_t CsvTable::column(std::string_view name) const {
  if (const auto found = find(name)) return *found;
  std::string known;
  for (const std::string& each : header_) known += (known.empty() ? "" : ",") + each;
  throw UserError(name_, "has no column `" + std::string(name) + "`", "a header with it; found: " + known);
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  const auto value = parseNumber(text(row, column));
  if (!value) throw UserError(where(row), header_[column] + " = `" + text(row, column) + "`", "a finite number");
  return *value;
}

std::int64_t CsvTable::integer(std::size_t row, std::size_t column) const {
  const auto value = parseInteger(text(row, column));
  if (!value) throw UserError(where(row), header_[column] + " = `" + text(row, column) + "`", "a whole number");
  return *value;
}

std::string CsvTable::where(std::size_t row) const { return atLine(name_, lines_[row]); }

std::string printCsvRow(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    if (&cell != &cells.front()) line += ',';
    const bool is_comment = &cell == &cells.front() && cell.find_first_of("#%/") == 0;
    const bool plain =
        !is_comment && cell.find_first_of(",\"\n") == std::string::npos && trimmed(cell).size() == cell.size();
    if (plain) {
      line += cell;
      continue;
    }
    line += '"';
    for (const char c : cell) line += c == '"' ? std::string("\"\"") : c == '\n' ? std::string(" ") : std::string(1, c);
    line += '"';
  }
  return line + "\n";
}

}  // namespace urban_nav_core
