// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/level.hpp"

namespace pose_graph {

/// Tilt error of odometry since its first pose.
struct Tilt {
  urban_nav_core::StampNs stamp = 0;
  /// Rotation vector in the axes of the first pose, perpendicular to gravity, rad: Exp(turn) R_first_base is the
  /// corrected orientation for odometry's R_first_base.
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
};

/// Estimates the drift of roll and pitch of odometry every 2 s. Derivation: docs/derivations/gravity_alignment.md.
///
/// The tilt is a random walk observed by noisy specific forces. Gravity and a lever arm of the accelerometer are
/// constants, its bias is another random walk (smoother of Rauch, Tung and Striebel 1965). `variance`: of odometry's
/// rotation about an axis from the first pose to each pose, rad2, as stated by odometry. The scale of this variance and
/// the noise of the forces are estimated by maximum likelihood, with the stated values as a prior of six observations;
/// shocks are weighted down. Returns an empty result if gravity is unknown, as in estimateLevel(), or if the drift
/// exceeds the valid range of 0.3 rad.
std::vector<Tilt> tiltDrift(const urban_nav_core::Trajectory& odometry, const std::vector<double>& variance,
                            const std::vector<SpecificForce>& forces);

/// Returns the tilt at a stamp, linear in time between two tilts and constant after the last one; zero at `first` and
/// before it.
Eigen::Vector3d tiltAt(const std::vector<Tilt>& tilts, urban_nav_core::StampNs first, urban_nav_core::StampNs stamp);

}  // namespace pose_graph
