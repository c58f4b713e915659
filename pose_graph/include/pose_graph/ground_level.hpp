// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/level.hpp"
#include "urban_nav_core/types/ground_normal.hpp"

namespace pose_graph {

using urban_nav_core::GroundNormal;

/// Estimates the upward direction, in the axes of a pose given in the trajectory's world frame, as the robust mean of
/// ground normals along a trajectory (Tukey's weights), for robots without an accelerometer. Normals whose stamp
/// matches no pose are ignored. Level::gravity is 0. Level::trouble is TooShort if there are less than five normals.
///
/// WARNING: the ground is level only on average. The covariance allows for slopes of 1 deg that persist over 50 m; a
/// session that only goes downhill is levelled to its slope. The rotations of the trajectory are treated as exact, see
/// withRotations(). Derivation: docs/derivations/gravity_alignment.md.
Level estimateLevel(const urban_nav_core::Trajectory& trajectory, const std::vector<GroundNormal>& normals,
                    const urban_nav_core::Pose& T_world_first);

/// Returns whether the direction was estimated from ground normals, not from an accelerometer.
inline bool isFromGround(const Level& level) { return level.known() && level.gravity == 0.0; }

}  // namespace pose_graph
