// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "moments.hpp"

namespace laser_odometry {

/// Points of a sweep in one cube, registered as a unit.
struct Patch {
  Vector3d mean = Vector3d::Zero();        ///< m, in base_link
  Matrix3d covariance = Matrix3d::Zero();  ///< covariance of the points, m^2
  double count = 0.0;                      ///< points
  double time = 0.0;                       ///< mean time of the points, s after the reference time of the sweep
  double half_square = 0.0;                ///< mean of half of the squared time, s^2
};

/// Groups points by cubes of edge `size` (m), in the order of their first points. `times`: of the points, s.
std::vector<Patch> makePatches(const std::vector<Vector3d>& points, const std::vector<float>& times, double size);

}  // namespace laser_odometry
