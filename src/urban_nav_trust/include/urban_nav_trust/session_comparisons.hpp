// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "urban_nav_trust/test_results.hpp"

namespace urban_nav_trust {

constexpr const char* kGravityTest = "ground_gravity";
constexpr const char* kLidarTest = "lidar_odometry";
constexpr const char* kLidarScaleTest = "stereo_lidar_scale";

/// The upward direction by one kind of measurement, in axes that both share.
struct UpEstimate {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();         ///< unit
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< rad^2, zero along `up`
};
/// Tests the normals of the ground that stereo sees against the gravity that the accelerometer measures. Nullopt: not
/// known, for which `absent_reason` is stated.
void testGravity(const std::optional<UpEstimate>& by_ground, const std::optional<UpEstimate>& by_accelerometer,
                 const Interval& interval, const char* absent_reason, TestResults& results);

/// Comparison of stereo odometry with that of a LiDAR over stretches of 1 s (urban_nav_core::FusedOdometry).
struct LidarComparison {
  Interval interval;  ///< in which both measured
  std::size_t stretches = 0;
  double spread = 1.0;   ///< mean squared Mahalanobis distance over 6; covariances have been multiplied by it
  double largest = 0.0;  ///< squared distance of the worst contradiction; 0: none
  Interval worst;        ///< its interval
  std::size_t contradictions = 0;
  double scale = 0.0, scale_sigma = 0.0;  ///< correction of stereo's lengths, relative; sigma 0: not estimated
};
/// Tests both odometries against each other. `rig_scale`: relative standard deviation of lengths that calibration
/// leaves.
void testLidar(const std::optional<LidarComparison>& comparison, double rig_scale, TestResults& results);

}  // namespace urban_nav_trust
