// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav {

/// Returns the numbers of a small matrix in a text file, row by row: a table (TextTable) without a header, or all in
/// one row. Throws UserError naming file and line for a value that is not a finite number.
std::vector<double> readMatrixFile(const std::string& path);

}  // namespace urban_nav
