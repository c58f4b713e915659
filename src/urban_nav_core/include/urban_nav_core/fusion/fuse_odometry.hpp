// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// Prior standard deviations and limits of fuseOdometry().
struct FusionOptions {
  double mounting_sigma = 0.035;      ///< standard deviation of the mounting rotation of the LiDAR in base_link, each
                                      ///< axis, rad
  double scale_sigma = 0.02;          ///< relative standard deviation of the stereo scale (baseline and focal length)
  double acceleration = 1.0;          ///< m/s^2, one sigma: error of poses interpolated between sweeps
  double angular_acceleration = 0.5;  ///< rad/s^2, one sigma
};

/// Odometry from which a step of the fused chain is taken.
enum class StepSource { None, Stereo, Laser, Both };

/// Constant common to all steps, estimated from the difference of the two odometries.
struct SharedConstant {
  std::string name;  ///< "mounting_x", "mounting_y", "mounting_z" (rad), or that of a ConsideredConstant
  double value = 0.0;
  double sigma = 0.0;
  bool is_applied = true;  ///< false: the given mounting is kept, since the comparison does not contradict it
};

/// Interval in which the odometries differ by more than their covariances allow.
struct OdometryConflict {
  StampNs from = 0, to = 0;
  double statistic = 0.0;  ///< squared Mahalanobis distance, 6 degrees of freedom
  double distance_m = 0.0;
  double angle_rad = 0.0;
};

/// Motion estimated from two odometries.
struct FusedOdometry {
  std::vector<RelativePose> steps;     ///< between the times of the stereo frames; constants: independent, sigma 1
  std::vector<StepSource> sources;     ///< one for each step
  std::vector<SharedConstant> shared;  ///< mounting first; empty if no interval has both odometries
  std::vector<OdometryConflict> conflicts;
  double spread = 1.0;  ///< mean squared distance of the odometries / 6; above 1 all covariances were multiplied by it
};

/// Fuses visual and LiDAR odometry (docs/derivations/odometry_fusion.md). Both chains are of base_link, in order of
/// time, each step beginning at the end of the previous one. Steps whose status is LOST are not used where the other
/// odometry has one. The result has the times of the stereo steps. `p_base_lidar`: position of the LiDAR in base_link,
/// m.
FusedOdometry fuseOdometry(const std::vector<RelativePose>& stereo, const std::vector<RelativePose>& laser,
                           const Vector3d& p_base_lidar, const FusionOptions& options = {});

}  // namespace urban_nav_core
