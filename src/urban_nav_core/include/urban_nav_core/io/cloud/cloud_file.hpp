// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "urban_nav_core/types/point_cloud.hpp"

namespace urban_nav_core {

/// The points of a file, whatever it is called: its first bytes say which kind it is, and the name only tells CSV from
/// text that is none.
///   PLY: ascii and binary of both byte orders; the element `vertex`, with origin_x, origin_y, origin_z the origins of
///   the beams as
///     well; any further elements and properties are skipped;
///   PCD: ascii, binary, binary_compressed; the fields x, y, z among any others;
///   CSV: one point a line, columns between commas, semicolons, tabs or blanks; with a header the columns x, y, z,
///   without one the first three; lines that begin with # are skipped; gzip of each.
/// Points are taken as they stand, in m; "nan" and infinities are kept (the caller leaves them out). Throws UserError
/// with file and, where there are lines, line for everything else: a count that is more than the file holds, a word
/// that is no number, a missing column.
PointCloud readCloud(const std::string& path);

/// The same of a file's content; `name` stands for the path in errors.
PointCloud parseCloud(std::string_view content, const std::string& name);

}  // namespace urban_nav_core
