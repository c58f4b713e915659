// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/csv.hpp"

#include <algorithm>
#include <iterator>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

// One cell from `at` on; leaves `at` on the separator or the end.
std::string takeCell(std::string_view line, std::size_t& at, const std::string& where) {
  while (at < line.size() && line[at] == ' ') ++at;
  if (at >= line.size() || line[at] != '"') {
    const std::size_t end = std::min(line.find(',', at), line.size());
    const std::string cell(trimmed(line.substr(at, end - at)));
    at = end;
    return cell;
  }
  std::string cell;
  for (++at; at < line.size(); ++at) {
    const bool quote = line[at] == '"';
    if (quote && at + 1 < line.size() && line[at + 1] == '"') {
      ++at;
    } else if (quote) {
      break;
    }
    cell += line[at];
  }
  if (at >= line.size()) throw UserError(where, "a quote that does not end", "");
  for (++at; at < line.size() && line[at] != ','; ++at) {
    if (line[at] != ' ') throw UserError(where, "text after a quote", "a comma");
  }
  return cell;
}

std::vector<std::string> splitLine(std::string_view line, const std::string& where) {
  std::vector<std::string> cells;
  std::size_t at = 0;
  while (true) {
    cells.push_back(takeCell(line, at, where));
    if (at >= line.size()) return cells;
    ++at;
  }
}

}  // namespace

CsvTable CsvTable::read(const std::string& path) { return parse(readTextFile(path), path); }

CsvTable CsvTable::parse(std::string_view text, const std::string& name) {
  CsvTable table;
  table.name_ = name;
  forEachLine(text, [&table, &name](std::string_view line, int number) {
    if (trimmed(line).empty()) return;
    const std::string where = atLine(name, number);
    if (table.header_.empty()) {
      if (line.front() == '#') line.remove_prefix(1);
      table.header_ = splitLine(line, where);
      return;
    }
    std::vector<std::string> cells = splitLine(line, where);
    if (cells.size() != table.header_.size()) {
      throw UserError(where, std::to_string(cells.size()) + " cells",
                      std::to_string(table.header_.size()) + ", as in the header");
    }
    std::move(cells.begin(), cells.end(), std::back_inserter(table.cells_));
    table.lines_.push_back(number);
  });
  if (table.header_.empty()) throw UserError(name, "is empty", "a header line and rows");
  return table;
}

bool CsvTable::has(std::string_view column) const {
  return std::find(header_.begin(), header_.end(), column) != header_.end();
}

std::size_t CsvTable::column(std::string_view name) const {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found != header_.end()) return static_cast<std::size_t>(found - header_.begin());
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
    const bool plain = cell.find_first_of(",\"\n") == std::string::npos && trimmed(cell).size() == cell.size();
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
