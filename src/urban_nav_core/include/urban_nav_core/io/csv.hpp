// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_core {

/// Text table with one header line, in any form that TextTable reads. Every row has as many cells as the header.
/// Columns are found by their exact name, else by plainName().
class CsvTable {
 public:
  /// Read a table. Throw UserError with file and line.
  static CsvTable read(const std::string& path);
  static CsvTable parse(std::string_view text, const std::string& name);

  std::size_t rows() const { return lines_.size(); }
  const std::vector<std::string>& header() const { return header_; }
  bool has(std::string_view column) const;
  /// Returns the index of a column. Throws UserError naming the file if there is no column of this name.
  std::size_t column(std::string_view name) const;

  const std::string& text(std::size_t row, std::size_t column) const { return cells_[row * header_.size() + column]; }
  /// Return the number in a cell. Throw UserError with file, line and column if it is not a finite number.
  double number(std::size_t row, std::size_t column) const;
  std::int64_t integer(std::size_t row, std::size_t column) const;
  /// Returns "file.csv:12", for errors raised by the caller.
  std::string where(std::size_t row) const;

 private:
  std::optional<std::size_t> find(std::string_view column) const;

  std::string name_;
  std::vector<std::string> header_;
  std::vector<std::string> cells_;
  std::vector<int> lines_;
};

/// Returns one line with its line end; cells are quoted where necessary.
std::string printCsvRow(const std::vector<std::string>& cells);

}  // namespace urban_nav_core
