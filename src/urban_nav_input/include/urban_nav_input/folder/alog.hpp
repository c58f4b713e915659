// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// One row of a MOOS asynchronous log. The value may have spanned several lines; it has no blanks at its ends.
struct AlogRow {
  urban_nav_core::StampNs logged = 0;  ///< time of logging, ns since LOGSTART
  std::string variable, source, value;
  int line = 0;  ///< of its beginning, from 1
};

/// Reads a log row by row, in the order of the file (which is not that of time), in bounded memory.
class AlogReader {
 public:
  /// Throws UserError if the file cannot be opened.
  explicit AlogReader(std::string path);

  /// Returns the Unix time of AlogRow::logged = 0; nullopt until a LOGSTART comment has been read.
  std::optional<urban_nav_core::StampNs> logStart() const { return log_start_; }

  /// Returns the next row; nullopt at the end. Throws UserError with file and line for text before the first row that
  /// is not a comment, and for a value longer than 16 MB.
  std::optional<AlogRow> next();

 private:
  bool readLine();
  void comment();

  std::string path_;
  std::ifstream file_;
  std::string line_;
  int number_ = 0;
  bool has_line_ = false;
  std::optional<urban_nav_core::StampNs> log_start_;
};

/// Parses the `key=value,key=value` of a value, with arrays `[n]{...}` and `[rxc]{...}` that may contain commas. Refers
/// to the text of the row, which must outlive it.
class AlogFields {
 public:
  /// `where` begins the errors: "file.alog:212".
  AlogFields(std::string_view value, std::string where);

  bool has(std::string_view key) const;
  /// All throw UserError with file, line and key for a missing key, a number that is invalid or not finite, or an array
  /// whose size differs from that in its brackets, or from `count` if not 0.
  std::string_view text(std::string_view key) const;
  double number(std::string_view key) const;
  urban_nav_core::StampNs stamp(std::string_view key) const;
  std::vector<double> array(std::string_view key, std::size_t count = 0) const;

 private:
  std::vector<std::pair<std::string_view, std::string_view>> fields_;
  std::string where_;
};

}  // namespace urban_nav_input
