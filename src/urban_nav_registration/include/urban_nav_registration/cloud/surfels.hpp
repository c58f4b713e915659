// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "urban_nav_core/types/point_cloud.hpp"

namespace urban_nav_registration {

/// Surface element: the points of one cube of the grid, with the normal of its neighbourhood.
struct Surfel {
  Eigen::Vector3f mean;    ///< of the points in the cube, m
  Eigen::Vector3f normal;  ///< unit, towards the cloud's origin; of the 27 cubes around, each with equal weight
  float planarity = 0.0F;  ///< 0...1: 1 - thickness / second extent, as variances; 0 where there is no surface (a line,
                           ///< a bush, a lone point)
};

/// Cloud prepared for alignment.
struct Surfels {
  std::vector<Surfel> all;   ///< in the order in which the cloud came to their cubes
  float voxel = 0.0F;        ///< edge of the cubes, m
  std::size_t points = 0;    ///< that were used
  std::size_t left_out = 0;  ///< NaN, infinite, or beyond the grid
  /// Unit normal of the plane in which all points lie, and the sensor with them: a scan of one plane. Normals of its
  /// surfaces lie in the plane.
  std::optional<Eigen::Vector3f> scan_plane;
};

/// Extracts surface elements in one pass over the points and one over the cubes. Normals come from the moments of
/// neighbouring cubes, without a search for nearest neighbours. The result does not depend on the number of threads.
/// Thread-safe.
Surfels makeSurfels(const urban_nav_core::PointCloud& cloud, float voxel);

}  // namespace urban_nav_registration
