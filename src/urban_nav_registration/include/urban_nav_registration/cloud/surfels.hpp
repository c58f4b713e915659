// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "urban_nav_core/types/point_cloud.hpp"

namespace urban_nav_registration {

/// Surface element: mean of the points in one cube of the grid, and normal of its neighbourhood.
struct Surfel {
  Eigen::Vector3f mean;    ///< mean of the points in the cube, m
  Eigen::Vector3f normal;  ///< unit, towards the cloud's origin; from the 27 cubes around, equally weighted
  float planarity = 0.0F;  ///< 0...1: 1 - thickness / second extent, as variances; 0 if there is no surface (a line, a
                           ///< bush, an isolated point)
};

/// Cloud prepared for alignment.
struct Surfels {
  std::vector<Surfel> all;   ///< ordered by the first point of each cube
  float voxel = 0.0F;        ///< edge of the cubes, m
  std::size_t points = 0;    ///< points used
  std::size_t left_out = 0;  ///< points that are not finite, or beyond the grid
  /// Unit normal of the plane if all points and the sensor lie in one plane (a planar scan). Normals of its surfaces
  /// lie in the plane.
  std::optional<Eigen::Vector3f> scan_plane;
};

/// Extracts surface elements in one pass over the points and one over the cubes. Normals come from the moments of
/// neighbouring cubes, without a search for nearest neighbours. The result does not depend on the number of threads.
/// Thread-safe.
Surfels makeSurfels(const urban_nav_core::PointCloud& cloud, float voxel);

}  // namespace urban_nav_registration
