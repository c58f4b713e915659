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

/// Returns the level motion that minimises the weighted mean square distance of `from` to `to`. All vectors have the
/// same length; positions in m; weights are non-negative and at least one is positive. Without horizontal extent the
/// turn is 0.
LevelMotion fitLevelMotion(const std::vector<Vector3d>& from, const std::vector<Vector3d>& to,
                           const std::vector<double>& weights);

}  // namespace urban_nav_core
