// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "urban_nav_core/types/point_cloud.hpp"

namespace urban_nav_core {

/// Points of a file, m. A point of the file is `offset` + a point of `cloud`, so that map coordinates hundreds of
/// kilometres from their origin keep their accuracy in single precision.
struct CloudFile {
  PointCloud cloud;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

/// Reads a point cloud file. The format is recognised by the first bytes, not by the name.
///   - PLY: ascii and binary of both byte orders; the element `vertex`; origin_x, origin_y, origin_z are the origins of
///     the beams; other elements, properties and lists are skipped.
///   - PCD: ascii, binary, binary_compressed; the fields x, y, z among any others.
///   - LAS 1.0 to 1.4, any point format.
///   - CSV, TXT, PTS: one point a line, columns separated by commas, semicolons, tabs or blanks; with a header the
///     columns x, y, z, without one the first three; lines that begin with # and point counts are skipped.
///   - gzip of each.
/// "nan" and infinities are kept; the caller filters them. The offset is zero where the centre of the points is within
/// 1 km of the origin. Throws UserError with file, and line in text files, for all other content: a count larger than
/// the file, a non-numeric word, a missing column.
CloudFile readCloud(const std::string& path);

/// Parses the content of such a file; `name` replaces the path in errors.
CloudFile parseCloud(std::string_view content, const std::string& name);

/// Moves the cloud so that its centre (median by axis) is the origin, and adjusts the offset.
void recentre(CloudFile& file);

}  // namespace urban_nav_core
