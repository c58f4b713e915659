// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "urban_nav_core/types/point_cloud.hpp"

namespace loop_metric {

/// A piece of surface: what one cube of the grid holds of a cloud, and how its neighbourhood lies.
struct Surfel {
  Eigen::Vector3f mean;    ///< of the points in the cube, m
  Eigen::Vector3f normal;  ///< unit, towards the cloud's origin; of the 27 cubes around, each with equal weight
  float planarity =
      0.0F;  ///< 0...1: 1 - thickness / second extent, as variances; 0 where there is no surface (a line, a bush, a lone point)
};

/// A cloud ready to be aligned.
struct Surfels {
  std::vector<Surfel> all;   ///< in the order in which the cloud came to their cubes
  float voxel = 0.0F;        ///< edge of the cubes, m
  std::size_t points = 0;    ///< that were used
  std::size_t left_out = 0;  ///< NaN, infinite, or beyond the grid
};

/// In one pass over the points and one over the cubes; normals come from the moments of neighbouring cubes instead of a search for
/// neighbours, which is where the time goes elsewhere. Result independent of the number of threads.
Surfels makeSurfels(const urban_nav_core::PointCloud& cloud, float voxel);

}  // namespace loop_metric
