// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/level.hpp"
#include "urban_nav_core/types/ground_normal.hpp"

namespace pose_graph {

using urban_nav_core::GroundNormal;

/// Estimates the upward direction from the ground along a trajectory, seen from a pose of the trajectory's world: the
/// robust mean of the normals (Tukey's weights), for robots without an accelerometer. Normals whose stamp is that of no
/// pose are ignored. Level::gravity is 0. Level::trouble is TooShort with less than five normals.
///
/// WARNING: ground is level on average only. The covariance allows for slopes of 1 deg that persist over 50 m; a
/// session that only goes downhill is levelled as its hill. The trajectory's rotations are taken as exact: see
/// withRotations. Derivation: docs/derivations/gravity_alignment.md.
Level estimateLevel(const urban_nav_core::Trajectory& trajectory, const std::vector<GroundNormal>& normals,
                    const urban_nav_core::Pose& T_world_first);

/// Returns whether a direction is known from the ground, not from an accelerometer.
inline bool isFromGround(const Level& level) { return level.known() && level.gravity == 0.0; }

}  // namespace pose_graph
