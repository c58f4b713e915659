// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/session_comparisons.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"
#include "urban_nav_core/trajectory/normal_tail.hpp"

namespace urban_nav_trust {

using urban_nav_core::formatNumber;

namespace {

constexpr double kDegrees = 180.0 / M_PI;
constexpr double kPoseNumbers = 6.0;

double chiSquareTail(double x, double dof) { return 1.0 - urban_nav_core::chiSquareProbability(x, dof); }

/// Returns two unit vectors orthogonal to a vertical direction, as columns.
Eigen::Matrix<double, 3, 2> across(const Eigen::Vector3d& up) {
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = up.unitOrthogonal();
  axes.col(1) = up.cross(axes.col(0));
  return axes;
}

void addLidarScale(const LidarComparison& lidar, double rig_scale, TestResults& results) {
  if (!(lidar.scale_sigma > 0.0)) {
    results.absent.push_back({kLidarScaleTest, "stereo and LiDAR odometry did not determine the scale of stereo"});
    return;
  }
  const double z = lidar.scale / std::hypot(lidar.scale_sigma, rig_scale);
  ConsistencyTest test;
  test.name = kLidarScaleTest;
  test.interval = lidar.interval;
  test.statistic = z * z;
  test.degrees_of_freedom = 1.0;
  test.p_value = urban_nav_core::normalTwoSidedTail(z);
  test.sentence = "Distances by stereo are " + formatNumber(100.0 * std::abs(lidar.scale)) + " % (+-" +
                  formatNumber(100.0 * lidar.scale_sigma, 2) + ") " + (lidar.scale > 0.0 ? "shorter" : "longer") +
                  " than those by the LiDAR.";
  test.remedy =
      "The baseline or the focal length of the stereo pair is wrong: calibrate it, or set "
      "input.baseline_scale to " +
      formatNumber(1.0 + lidar.scale, 4) + ".";
  results.tests.push_back(std::move(test));
}

}  // namespace

void testGravity(const std::optional<UpEstimate>& by_ground, const std::optional<UpEstimate>& by_accelerometer,
                 const Interval& interval, const char* absent_reason, TestResults& results) {
  if (!by_ground || !by_accelerometer) {
    results.absent.push_back({kGravityTest, absent_reason});
    return;
  }
  const Eigen::Matrix<double, 3, 2> axes = across(by_accelerometer->up);
  const Eigen::Vector2d difference = axes.transpose() * (by_ground->up - by_accelerometer->up);
  const Eigen::Matrix2d covariance = axes.transpose() * (by_ground->covariance + by_accelerometer->covariance) * axes;
  ConsistencyTest test;
  test.name = kGravityTest;
  test.interval = interval;
  test.statistic = difference.dot(covariance.ldlt().solve(difference));
  test.degrees_of_freedom = 2.0;
  test.p_value = std::exp(-0.5 * test.statistic);
  const double angle =
      std::atan2(by_ground->up.cross(by_accelerometer->up).norm(), by_ground->up.dot(by_accelerometer->up));
  test.sentence = "The mean ground plane by stereo is tilted by " + formatNumber(kDegrees * angle) + " deg (+-" +
                  formatNumber(kDegrees * std::sqrt(0.5 * covariance.trace()), 2) +
                  ") relative to the horizontal plane by the accelerometer.";
  test.remedy =
      "The roll or pitch of the stereo head or of the IMU differs from /tf_static: measure both, and correct "
      "/tf_static.";
  results.tests.push_back(std::move(test));
}

void testLidar(const std::optional<LidarComparison>& comparison, double rig_scale, TestResults& results) {
  if (!comparison || comparison->stretches < 2) {
    results.absent.push_back({kLidarTest, "no LiDAR odometry with images for two seconds"});
    results.absent.push_back({kLidarScaleTest, "no LiDAR odometry with images for two seconds"});
    return;
  }
  const double axes = kPoseNumbers * static_cast<double>(comparison->stretches);
  ConsistencyTest test;
  test.name = kLidarTest;
  test.interval = comparison->contradictions > 0 ? comparison->worst : comparison->interval;
  test.statistic = comparison->spread;
  test.degrees_of_freedom = axes;
  // All intervals together, and the worst of them: the smaller p-value is doubled (Bonferroni).
  const double of_all = probabilityUnderUnknownScale(axes * comparison->spread,
                                                     [&](double x) { return chiSquareTail(x, axes); }),
               of_worst = static_cast<double>(comparison->stretches) *
                          probabilityUnderUnknownScale(comparison->largest,
                                                       [](double x) { return chiSquareTail(x, kPoseNumbers); });
  test.p_value = std::min(1.0, 2.0 * std::min(of_all, of_worst));
  test.sentence = "Over " + std::to_string(comparison->stretches) +
                  " intervals of 1 s, stereo and LiDAR odometry differ by " +
                  formatNumber(std::sqrt(comparison->spread), 3) + " times the stated standard deviation; in " +
                  std::to_string(comparison->contradictions) + " intervals they contradict each other.";
  test.remedy =
      "Stereo or LiDAR odometry is wrong: compare the paths by --odometry stereo and --odometry laser, and check the "
      "clocks and the mounting (/tf_static) of cameras and LiDAR.";
  results.tests.push_back(std::move(test));
  // Covariances were multiplied by the spread: the normalised residuals have mean square one.
  ScaleWeights log_likelihoods{};
  for (std::size_t i = 0; i < kScaleCount; ++i) {
    const double variance = covarianceScales()[i] * covarianceScales()[i];
    log_likelihoods[i] = -0.5 * axes * (1.0 / variance + std::log(variance));
  }
  results.turns.add(log_likelihoods);
  results.lengths.add(log_likelihoods);
  addLidarScale(*comparison, rig_scale, results);
}

}  // namespace urban_nav_trust
