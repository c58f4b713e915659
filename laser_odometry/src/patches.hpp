// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "moments.hpp"
#include "sweep_points.hpp"

namespace laser_odometry {

/// Points of a sweep in one cube, registered as a unit.
struct Patch {
  Vector3d mean = Vector3d::Zero();        ///< m, in base_link
  Matrix3d covariance = Matrix3d::Zero();  ///< covariance of the points, m^2
  double count = 0.0;                      ///< points
  double time = 0.0;                       ///< mean time of the points, s after the reference time of the sweep
  double half_square = 0.0;                ///< mean of half of the squared time, s^2
};

/// Groups segments by the cubes of edge `size` (m) that hold their means, in the order of their first segments.
std::vector<Patch> makePatches(const std::vector<Segment>& segments, double size);

}  // namespace laser_odometry
