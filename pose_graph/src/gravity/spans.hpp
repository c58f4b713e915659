// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/level.hpp"

namespace pose_graph {

/// An interval of a drive with mean values.
struct Span {
  urban_nav_core::StampNs begin = 0, end = 0;
  /// Mean specific force in the axes of the first pose, minus the acceleration of the trajectory (m/s2): gravity and
  /// bias.
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /// Mean of R_first_base: effect of a bias fixed to the robot.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  /// Mean rate of change of R_first_base [rate]x, 1/s2: effect of a lever arm in base_link during rotation.
  Eigen::Matrix3d lever = Eigen::Matrix3d::Zero();
};

constexpr double kUsualSpan = 2.0;  ///< s

/// Returns consecutive spans of at least `seconds` each; spans do not extend over gaps of more than 0.3 s between
/// forces. Consecutive spans share the velocity between them, so its error cancels in their sum.
std::vector<Span> makeSpans(const urban_nav_core::Trajectory& trajectory, const std::vector<SpecificForce>& forces,
                            const urban_nav_core::Pose& T_world_first, double seconds = kUsualSpan);

}  // namespace pose_graph
