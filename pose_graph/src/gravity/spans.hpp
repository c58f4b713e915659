// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/level.hpp"

namespace pose_graph {

/// A stretch of a drive, over which means are taken.
struct Span {
  urban_nav_core::StampNs begin = 0, end = 0;
  /// Of the specific force, in the axes of the first pose, less the acceleration that the trajectory shows (m/s2):
  /// gravity and faults.
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /// Of R_first_base: what it does to a fault that is fixed to the robot.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  /// Of the change of R_first_base [rate]x, 1/s2: what the robot's turning does at a lever arm in base_link.
  Eigen::Matrix3d lever = Eigen::Matrix3d::Zero();
};

constexpr double kUsualSpan = 2.0;  ///< s

/// One after another, each of `seconds` or a little more; none where forces are more than 0.3 s apart. Two that follow
/// each other share the velocity between them, so its error takes itself away in their sum.
std::vector<Span> makeSpans(const urban_nav_core::Trajectory& trajectory, const std::vector<SpecificForce>& forces,
                            const urban_nav_core::Pose& T_world_first, double seconds = kUsualSpan);

}  // namespace pose_graph
