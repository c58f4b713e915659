// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/level.hpp"

namespace pose_graph {

/// How far odometry has lost which way is up since its first pose.
struct Tilt {
  urban_nav_core::StampNs stamp = 0;
  /// rad, in the axes of the first pose, across gravity: Exp(turn) R_first_base is how the robot leant, for odometry's
  /// R_first_base.
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
};

/// Derivation: docs/derivations/gravity_alignment.md.
///
/// The drift of roll and pitch, once each 2 s: a random walk that forces see through noise, beside a gravity and a
/// lever arm of the accelerometer that are the same all along, and a fault of it that walks too (Rauch, Tung and
/// Striebel 1965). `variance`: of odometry's rotation about an axis, rad2, added up from the first pose to each, as
/// odometry promises it. By how much it promises too much, and what a force is worth, is as the drive shows it (largest
/// likelihood, with odometry's word as six observations); shocks weigh less. Empty where gravity is not known, as
/// estimateLevel, or the drift is more than this can tell, 0.3 rad.
std::vector<Tilt> tiltDrift(const urban_nav_core::Trajectory& odometry, const std::vector<double>& variance,
                            const std::vector<SpecificForce>& forces);

/// Between two of them as time goes, beyond the last as that one; at `first`, and before it, none.
Eigen::Vector3d tiltAt(const std::vector<Tilt>& tilts, urban_nav_core::StampNs first, urban_nav_core::StampNs stamp);

}  // namespace pose_graph
