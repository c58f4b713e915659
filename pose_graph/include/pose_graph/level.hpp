// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_core/types/specific_force.hpp"

namespace pose_graph {

using urban_nav_core::SpecificForce;

/// Returns the mean of the samples around each stamp: from half-way to the previous stamp to half-way to the next one,
/// at most 0.1 s away. Stamps without samples are left out. Samples that are not finite or exceed 1000 m/s2 are
/// ignored. `stamps` ascend; samples may be in any order.
std::vector<SpecificForce> forcesAt(const std::vector<urban_nav_core::StampNs>& stamps,
                                    std::vector<SpecificForce> samples);

/// Why the upward direction could not be estimated.
enum class LevelTrouble {
  None,
  NoForces,    ///< no specific force was measured at any pose
  TooShort,    ///< less than five intervals of 0.25 s without a gap
  NotGravity,  ///< the norm of the specific force is not that of gravity: other units, or gravity is already removed
};
const char* toString(LevelTrouble trouble);

/// Estimate of the upward direction in the axes of a reference pose ("first").
struct Level {
  LevelTrouble trouble = LevelTrouble::NoForces;
  std::string sentence;  ///< message for the user if the direction is unknown
  bool known() const { return trouble == LevelTrouble::None; }

  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();         ///< unit vector
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of `up`, rad2; zero along `up`
  double sigma = 0.0;                                    ///< larger of the two standard deviations, rad
  double gravity = 0.0;                                  ///< measured magnitude, m/s2
  /// Rotation of a frame `map` at the reference pose with z up and heading zero: its x axis is the horizontal
  /// projection of the reference pose's x axis. Identity if the direction is unknown.
  Eigen::Matrix3d R_map_first = Eigen::Matrix3d::Identity();
};

/// Estimates the upward direction from all specific forces of a drive. Derivation:
/// docs/derivations/gravity_alignment.md.
///
/// The forces are rotated into the axes of the first pose by the trajectory's rotations, and the trajectory's change of
/// velocity is subtracted. Gravity and accelerometer bias remain. The bias rotates with the robot, hence the two are
/// separable if the robot has turned; otherwise the covariance is large. Both are estimated by linear least squares
/// over intervals of 2 s (shorter in a session of a few seconds), reweighted by Huber's function (1964), with the noise
/// estimated from the residuals. The rotations of the trajectory are treated as exact, see withRotations().
///
/// A force is used if its stamp is that of a pose. The accelerometer is assumed at the origin of base_link: the effect
/// of its lever arm in turns averages out over the intervals. An orientation filtered by the IMU from the same forces
/// is not used, since the filter has only part of the drive's data.
Level estimateLevel(const urban_nav_core::Trajectory& trajectory, const std::vector<SpecificForce>& forces);
/// As above, in the axes of the pose T_world_first instead of the trajectory's first pose.
Level estimateLevel(const urban_nav_core::Trajectory& trajectory, const std::vector<SpecificForce>& forces,
                    const urban_nav_core::Pose& T_world_first);

/// Adds the uncertainty of the trajectory's rotations: their common error is indistinguishable from a tilt of the first
/// pose. `covariance`: of that tilt, rad2, as a small rotation in the axes of the first pose.
Level withRotations(Level level, const Eigen::Matrix3d& covariance);

}  // namespace pose_graph
