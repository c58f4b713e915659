// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "urban_nav_core/types/point_cloud.hpp"

namespace urban_nav_core {

/// The points of a file, m. A point of the file is `offset` + a point of `cloud`: coordinates of a map, hundreds of
/// kilometres from their origin, keep their accuracy.
struct CloudFile {
  PointCloud cloud;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

/// Reads a file of points, whatever it is called: its first bytes tell the format.
///   - PLY: ascii and binary of both byte orders; the element `vertex`; origin_x, origin_y, origin_z are the origins of
///     the beams; other elements, properties and lists are skipped.
///   - PCD: ascii, binary, binary_compressed; the fields x, y, z among any others.
///   - LAS 1.0 to 1.4, any point format.
///   - CSV, TXT, PTS: one point a line, columns between commas, semicolons, tabs or blanks; with a header the columns
///     x, y, z, without one the first three; lines that begin with # and counts of points are skipped.
///   - gzip of each.
/// "nan" and infinities are kept for the caller to leave out. The offset is zero where the middle of the points is
/// within 1 km of the origin. Throws UserError with file and, where there are lines, line for everything else: a count
/// that is more than the file holds, a word that is no number, a missing column.
CloudFile readCloud(const std::string& path);

/// The same of a file's content; `name` stands for the path in errors.
CloudFile parseCloud(std::string_view content, const std::string& name);

/// Moves the cloud so that the middle of its points (median by axis) is its origin.
void recentre(CloudFile& file);

}  // namespace urban_nav_core
