// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ground_level.hpp"

#include <algorithm>
#include <cmath>

#include "gravity/level_axes.hpp"

namespace pose_graph {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using urban_nav_core::Pose;
using urban_nav_core::Trajectory;

namespace {

constexpr std::size_t kLeastNormals = 5;
// Rad, m: standard deviation and correlation length of street slopes.
constexpr double kSlope = 0.01745, kSlopeLength = 50.0;
constexpr double kBumpLength = 10.0;             // m: correlation length of the errors of normals
constexpr double kLeastNormalScatter = 0.0035;   // rad
constexpr double kTukey = 4.685;                 // 95 % efficiency for normal errors
constexpr double kMedianToSigma = 1.0 / 1.1774;  // of the norm of a two-dimensional normal error
constexpr int kNormalRounds = 20;

/// Normals in the axes of the first pose, and the path length between the first and the last of them.
struct SeenGround {
  std::vector<Vector3d> normals;
  double path = 0.0;  ///< m
};

SeenGround toFirst(const Trajectory& trajectory, const std::vector<GroundNormal>& normals, const Pose& T_world_first) {
  SeenGround seen;
  if (trajectory.empty()) return seen;
  const Pose T_first_world = T_world_first.inverse();
  Pose last;
  for (const GroundNormal& each : normals) {
    const auto& at = trajectory[trajectory.nearest(each.stamp)];
    if (at.stamp != each.stamp || !each.up.allFinite() || std::abs(each.up.norm() - 1.0) > 1e-3) continue;
    if (!seen.normals.empty()) seen.path += distanceBetween(last, at.pose);
    last = at.pose;
    seen.normals.emplace_back(T_first_world.R() * at.pose.R() * each.up);
  }
  return seen;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Returns the direction of the componentwise medians.
Vector3d medianDirection(const std::vector<Vector3d>& normals) {
  Vector3d direction;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Vector3d& normal : normals) values.push_back(normal(axis));
    direction(axis) = median(std::move(values));
  }
  return direction.normalized();
}

double findScatter(const std::vector<Vector3d>& normals, const Vector3d& up) {
  std::vector<double> angles;
  for (const Vector3d& normal : normals) angles.push_back(normal.cross(up).norm());
  return std::max(kLeastNormalScatter, kMedianToSigma * median(std::move(angles)));
}

}  // namespace

Level estimateLevel(const Trajectory& trajectory, const std::vector<GroundNormal>& normals, const Pose& T_world_first) {
  const SeenGround seen = toFirst(trajectory, normals, T_world_first);
  if (seen.normals.size() < kLeastNormals)
    return unknownLevel(LevelTrouble::TooShort,
                        "only " + std::to_string(seen.normals.size()) + " keyframes with a ground normal");
  Vector3d up = medianDirection(seen.normals);
  double scatter = findScatter(seen.normals, up);
  for (int round = 0; round < kNormalRounds; ++round) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& normal : seen.normals) {
      const double share = normal.cross(up).norm() / (kTukey * scatter);
      if (share < 1.0 && normal.dot(up) > 0.0) sum += (1.0 - share * share) * (1.0 - share * share) * normal;
    }
    if (!(sum.norm() > 0.0)) break;
    up = sum.normalized();
    scatter = findScatter(seen.normals, up);
  }
  Level level;
  level.trouble = LevelTrouble::None;
  level.up = up;
  const double bumps = 1.0 + seen.path / kBumpLength, slopes = 1.0 + seen.path / kSlopeLength;
  level.covariance =
      (scatter * scatter / bumps + kSlope * kSlope / slopes) * (Matrix3d::Identity() - up * up.transpose());
  level.sigma = largestSigma(level.covariance);
  level.R_map_first = levelAxes(up);
  return level;
}

}  // namespace pose_graph
