// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_core::testing {

/// Table of measured figures for a README, the common output of all benches. Written to bench/results/NAME.json with
/// machine, commit and command line; rendered by scripts/tables.py.
class BenchTable {
 public:
  /// `arguments`: those of the program, stored in the file.
  BenchTable(std::vector<std::string> columns, int argc, char** argv);

  /// Adds a row with a cell for each column.
  void add(std::vector<std::string> cells);
  /// Adds a sentence below the table (options of a compared program, limitations of a figure).
  void note(std::string sentence);

  /// Returns the table for a terminal, with aligned columns.
  std::string text() const;
  /// Writes the JSON file atomically. Throws UserError if it cannot be written.
  void write(const std::string& path) const;

  const std::vector<std::vector<std::string>>& rows() const { return rows_; }

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::string> notes_;
  std::string command_;
};

/// Returns a number with a fixed number of decimals, for a cell.
std::string cell(double value, int decimals);
/// Returns the processor as named by the system: "Intel ... (2 cores)".
std::string machineName();
/// Returns the short commit of the working directory, with "+" if it was modified; "unknown" outside a repository.
std::string commitName();

}  // namespace urban_nav_core::testing
