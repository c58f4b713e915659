// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_core {

/// Row of a text table; views are valid during the call that hands them over.
struct TableRow {
  int line = 0;                         ///< from 1
  std::vector<std::string_view> cells;  ///< without quotes and surrounding blanks; numbers with a decimal point
};

/// A table of text as common programs write it: the one reader of trajectories, clouds, closures, image lists, stamps
/// and tables of devices. Cells are separated by commas, semicolons, tabs or blanks, whichever fits the first rows, and
/// may be in double quotes ("" is a quote, no line breaks); `sep=;` in the first line is followed. Numbers may have
/// decimal commas in quotes or where commas are no separator. Lines that begin with #, % or // are comments, as is what
/// follows a # in a row separated by blanks; the header is the last comment, or the first row, before all numbers,
/// holds none itself, and has as many cells as the rows have. One empty cell at the end of a row (a trailing separator)
/// is not one.
class TextTable {
 public:
  /// `text`: UTF-8, outlives the table. `name`: the path, for errors.
  TextTable(std::string_view text, std::string name);

  /// The names of columns as written; empty without a header.
  const std::vector<std::string>& header() const { return header_; }
  /// Whether the header is a comment, and so perhaps none: three words above three columns.
  bool headerIsComment() const { return header_is_comment_; }
  /// "file.csv:1", for errors that concern the header.
  std::string whereHeader() const;
  /// Makes the first row the header where none was found: for tables that always have one.
  void requireHeader();
  /// The number of cells that most of the first rows have; 0 for a table without rows.
  std::size_t width() const { return width_; }

  /// Calls `row` for each row but the header, in order. Throws UserError with file and line for a quote that does not
  /// end.
  void forEachRow(const std::function<void(const TableRow& row)>& row) const;
  /// "file.csv:12", for errors of the caller's own.
  std::string where(const TableRow& row) const;

 private:
  void findHeader();

  std::string_view text_;
  std::string_view head_;  // from which the format is determined
  std::string name_;
  char separator_ = ' ';
  bool has_decimal_commas_ = false;
  std::size_t width_ = 0;
  std::vector<std::string> header_;
  int header_line_ = 0;
  bool header_is_comment_ = false;
};

/// Returns the number that fills a cell, also "nan", "inf" and their like; nullopt for anything else.
std::optional<double> parseCell(std::string_view cell);

/// Returns text as it can be shown in an error: in quotes, of bounded length, printable.
std::string quotedCell(std::string_view cell);

}  // namespace urban_nav_core
