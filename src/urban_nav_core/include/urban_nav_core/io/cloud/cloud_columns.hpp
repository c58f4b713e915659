// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_core {

/// Columns of numbers of equal length; empty for a column that the file lacks.
using NumberColumns = std::vector<std::optional<std::vector<double>>>;

/// Returns the columns `wanted` of a file with one point per row: PLY (properties of the element vertex), LAS (x, y, z,
/// `intensity`, `classification`, and attributes by their names) or CSV with a header and commas, each optionally
/// compressed by gzip. Other columns are not read; "nan" and infinities are kept.
/// Throws UserError with file, and line in text files, for non-numeric words, rows of another length, and truncated
/// files.
NumberColumns readCloudColumns(const std::string& path, const std::vector<std::string>& wanted);

/// Parses the content of such a file; `name` replaces the path in errors.
NumberColumns parseCloudColumns(std::string_view content, const std::string& name,
                                const std::vector<std::string>& wanted);

}  // namespace urban_nav_core
