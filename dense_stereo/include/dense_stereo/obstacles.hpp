// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dense_stereo/ground_plane.hpp"

namespace dense_stereo {

/// Point of an obstacle.
struct ObstaclePoint {
  Eigen::Vector3f p_cam = Eigen::Vector3f::Zero();  ///< m, left optical frame
  float height = 0.0F;                              ///< m above the ground; negative in holes
};
/// Thresholds of the obstacle search.
struct ObstacleOptions {
  double least_height = 0.1;  ///< m: least height or depth of obstacles and holes
  double clearance = 2.0;     ///< m: higher points are above the robot
  double cell = 0.1;          ///< m, of the grid on the ground in which points support each other
  int least_pixels = 30;      ///< px of an obstacle, in a cell and its eight neighbours
};

/// Returns the points at least `least_height` above or below the ground. The standard deviation of a point's height is
/// subtracted, and isolated points are dropped. `step`: as in makePoints(). Empty without a ground plane. Pure.
std::vector<ObstaclePoint> findObstacles(const std::vector<DensePoint>& points, int step, const GroundPlane& ground,
                                         const ObstacleOptions& options = {});

}  // namespace dense_stereo
