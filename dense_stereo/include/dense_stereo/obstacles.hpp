// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dense_stereo/ground_plane.hpp"

namespace dense_stereo {

/// A point that a wheeled robot must not drive to.
struct ObstaclePoint {
  Eigen::Vector3f p_cam = Eigen::Vector3f::Zero();  ///< m, left optical frame
  float height = 0.0F;                              ///< m above the ground; negative in holes
};

struct ObstacleOptions {
  double least_height = 0.1;  ///< m: objects and holes of this height or depth are obstacles
  double clearance = 2.0;     ///< m: what is higher hangs above the robot
  double cell = 0.1;          ///< m, of the grid on the ground in which points support each other
  int least_pixels = 30;      ///< px of an obstacle, in a cell and its eight neighbours
};

/// Points that stand at least `least_height` above the ground, or lie as deep below it. The deviation of a point's
/// height counts against it, and lone points are dropped. `step`: as in makePoints. Empty if no ground was found.
/// Pure.
std::vector<ObstaclePoint> findObstacles(const std::vector<DensePoint>& points, int step, const GroundPlane& ground,
                                         const ObstacleOptions& options = {});

}  // namespace dense_stereo
