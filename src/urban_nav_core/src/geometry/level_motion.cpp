// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/level_motion.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace urban_nav_core {

Pose LevelMotion::pose() const { return Pose(Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ())), shift); }

LevelMotion fitLevelMotion(const std::vector<Vector3d>& from, const std::vector<Vector3d>& to,
                           const std::vector<double>& weights) {
  double all = 0.0;
  Vector3d mean_from = Vector3d::Zero(), mean_to = Vector3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    all += weights[i];
    mean_from += weights[i] * from[i];
    mean_to += weights[i] * to[i];
  }
  mean_from /= all;
  mean_to /= all;
  double sine = 0.0, cosine = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vector3d a = from[i] - mean_from, b = to[i] - mean_to;
    sine += weights[i] * (a.x() * b.y() - a.y() * b.x());
    cosine += weights[i] * (a.x() * b.x() + a.y() * b.y());
  }
  LevelMotion fit;
  fit.yaw = std::atan2(sine, cosine);
  fit.shift = mean_to - LevelMotion{fit.yaw, Vector3d::Zero()} * mean_from;
  return fit;
}

}  // namespace urban_nav_core
