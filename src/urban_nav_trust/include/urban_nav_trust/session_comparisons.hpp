// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "urban_nav_trust/test_results.hpp"

namespace urban_nav_trust {

constexpr const char* kGravityTest = "ground_gravity";
constexpr const char* kLidarTest = "lidar_odometry";
constexpr const char* kLidarScaleTest = "stereo_lidar_scale";

/// Vertical direction from one kind of measurement, in common axes.
struct UpEstimate {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();         ///< unit vector
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< rad^2, zero along `up`
};
/// Tests the ground normals from stereo against gravity from the accelerometer. nullopt: unavailable, for the reason
/// `absent_reason`.
void testGravity(const std::optional<UpEstimate>& by_ground, const std::optional<UpEstimate>& by_accelerometer,
                 const Interval& interval, const char* absent_reason, TestResults& results);

/// Comparison of stereo and LiDAR odometry over intervals of 1 s (urban_nav_core::FusedOdometry).
struct LidarComparison {
  Interval interval;  ///< measured by both
  std::size_t stretches = 0;
  double spread = 1.0;   ///< mean squared Mahalanobis distance / 6, by which covariances were multiplied
  double largest = 0.0;  ///< squared distance of the worst conflict; 0: none
  Interval worst;        ///< its interval
  std::size_t contradictions = 0;
  double scale = 0.0, scale_sigma = 0.0;  ///< relative correction of stereo lengths; sigma 0: not estimated
};
/// Tests the two odometries against each other. `rig_scale`: relative standard deviation of lengths after calibration.
void testLidar(const std::optional<LidarComparison>& comparison, double rig_scale, TestResults& results);

}  // namespace urban_nav_trust
