// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {

/// A turn about the vertical, rad, followed by a shift, m.
struct LevelMotion {
  double yaw = 0.0;
  Vector3d shift = Vector3d::Zero();

  Pose pose() const;
  Vector3d operator*(const Vector3d& p) const { return pose() * p; }
};

/// Returns the level motion that brings `from` closest to `to` in the weighted mean square. The vectors have the same
/// length, m, and weights (at least 0) of which one is positive; without horizontal extent the turn is 0.
LevelMotion fitLevelMotion(const std::vector<Vector3d>& from, const std::vector<Vector3d>& to,
                           const std::vector<double>& weights);

}  // namespace urban_nav_core
