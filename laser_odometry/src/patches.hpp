// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "moments.hpp"

namespace laser_odometry {

/// Points of a sweep in one cube: what is registered in place of single points.
struct Patch {
  Vector3d mean = Vector3d::Zero();        ///< m, in base_link
  Matrix3d covariance = Matrix3d::Zero();  ///< of the points, m^2
  double count = 0.0;                      ///< points
  double time = 0.0;                       ///< mean of the points, s after the reference time of the sweep
  double half_square = 0.0;                ///< mean of half of its square, s^2
};

/// Returns the points by cubes of edge `size` (m), in the order of their first points. `times`: of each point, s.
std::vector<Patch> makePatches(const std::vector<Vector3d>& points, const std::vector<float>& times, double size);

}  // namespace laser_odometry
