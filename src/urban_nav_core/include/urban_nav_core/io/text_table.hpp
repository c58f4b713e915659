// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_core {

/// Row of a text table; the views are valid during the callback only.
struct TableRow {
  int line = 0;                         ///< from 1
  std::vector<std::string_view> cells;  ///< without quotes and surrounding blanks; numbers with a decimal point
};

/// Reader of text tables as written by common programs, used for trajectories, clouds, closures, image lists, stamps
/// and device tables. Cells are separated by commas, semicolons, tabs or blanks, whichever fits the first rows, and may
/// be in double quotes ("" is a quote, no line breaks); `sep=;` in the first line is respected. Numbers may have
/// decimal commas in quotes or where commas are not separators. Lines that begin with #, % or // are comments, as is
/// the text after a # in a row separated by blanks. The header is the last comment or the first row before all numbers;
/// it contains no number and has as many cells as the rows. One empty cell at the end of a row (a trailing separator)
/// is ignored.
class TextTable {
 public:
  /// `text`: UTF-8, must outlive the table. `name`: path, for errors.
  TextTable(std::string_view text, std::string name);

  /// Returns the column names as written; empty without a header.
  const std::vector<std::string>& header() const { return header_; }
  /// Returns whether the header was a comment and is therefore uncertain: any three words above three columns.
  bool headerIsComment() const { return header_is_comment_; }
  /// Returns "file.csv:1", for errors that concern the header.
  std::string whereHeader() const;
  /// Uses the first row as header if none was found; for tables that always have one.
  void requireHeader();
  /// Returns the most frequent number of cells in the first rows; 0 for a table without rows.
  std::size_t width() const { return width_; }

  /// Calls `row` for each row except the header, in order. Throws UserError with file and line for an unterminated
  /// quote.
  void forEachRow(const std::function<void(const TableRow& row)>& row) const;
  /// Returns "file.csv:12", for errors raised by the caller.
  std::string where(const TableRow& row) const;

 private:
  void findHeader();

  std::string_view text_;
  std::string_view head_;  // from which the format is detected
  std::string name_;
  char separator_ = ' ';
  bool has_decimal_commas_ = false;
  std::size_t width_ = 0;
  std::vector<std::string> header_;
  int header_line_ = 0;
  bool header_is_comment_ = false;
};

/// Returns the number that fills a cell, including "nan" and "inf"; nullopt for anything else.
std::optional<double> parseCell(std::string_view cell);

/// Returns text for an error message: quoted, shortened, printable.
std::string quotedCell(std::string_view cell);

}  // namespace urban_nav_core
