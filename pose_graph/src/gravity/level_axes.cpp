// SPDX-License-Identifier: BSD-3-Clause
#include "gravity/level_axes.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/dense.hpp"

namespace pose_graph {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d levelAxes(const Vector3d& up) {
  Matrix3d rows;
  Vector3d ahead = Vector3d::UnitX() - up.x() * up;
  if (ahead.norm() < 1e-3) ahead = up.unitOrthogonal();  // x points up or down: the heading is undefined
  ahead.normalize();
  rows << ahead.transpose(), up.cross(ahead).transpose(), up.transpose();
  return rows;
}

double largestSigma(const Matrix3d& covariance) {
  const auto values = urban_nav_core::symmetricEigenvalues(covariance);
  return values ? std::sqrt(std::max(0.0, values->maxCoeff())) : 0.0;
}

Level unknownLevel(LevelTrouble trouble, const std::string& sentence) {
  Level level;
  level.trouble = trouble;
  level.sentence = sentence;
  return level;
}

}  // namespace pose_graph
