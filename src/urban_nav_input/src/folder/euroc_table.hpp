// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// A row of a data.csv file of EuRoC: a stamp, then numbers or names.
struct EurocRow {
  urban_nav_core::StampNs stamp = 0;
  std::vector<std::string> cells;  ///< including the stamp
  std::string where;               ///< "data.csv:12"

  /// Throws UserError with file and line if the cell is not a finite number.
  double number(std::size_t cell) const;
};
struct EurocTable {
  std::vector<EurocRow> rows;    ///< in strictly ascending order of stamps
  std::size_t repeated = 0;      ///< rows omitted since an earlier one has the same stamp
  std::size_t out_of_order = 0;  ///< rows that were sorted
  double unit = 1e-9;            ///< s: of the stamps in the file
};

/// Reads a data.csv in any form of TextTable: with or without a header line, in any order, with stamps in ns or, if
/// they have decimals or according to the header, in s. `meaning`: of the first `columns` columns, for errors. Throws
/// UserError with file and line.
EurocTable readEurocTable(const std::string& path, std::size_t columns, const std::string& meaning);

}  // namespace urban_nav_input
