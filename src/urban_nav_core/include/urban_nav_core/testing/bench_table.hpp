// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_core::testing {

/// A table of measured figures as a README shows it: the one form in which a bench leaves its results. Written to
/// bench/results/NAME.json with the machine, the commit and the command that made it; scripts/tables.py renders it.
class BenchTable {
 public:
  /// `arguments`: the program's own, to be repeated in the file.
  BenchTable(std::vector<std::string> columns, int argc, char** argv);

  /// A row of cells, as many as columns.
  void add(std::vector<std::string> cells);
  /// A sentence below the table (a peer's options, what limits a figure).
  void note(std::string sentence);

  /// For a terminal, columns aligned.
  std::string text() const;
  /// Writes the JSON file, beside and renamed. Throws UserError if it cannot.
  void write(const std::string& path) const;

  const std::vector<std::vector<std::string>>& rows() const { return rows_; }

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::string> notes_;
  std::string command_;
};

/// A number with a fixed count of decimals, for a cell.
std::string cell(double value, int decimals);
/// "Intel ... (2 cores)": the processor as the system names it.
std::string machineName();
/// The short commit of the working directory, with "+" if it was changed; "unknown" outside a repository.
std::string commitName();

}  // namespace urban_nav_core::testing
