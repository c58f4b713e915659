// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/estimate.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "urban_nav_core/testing/bands.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;
using urban_nav_core::testing::Dice;

StereoCamera estimateCamera() { return {{390.0, 390.0, 255.0, 195.0, 512, 384}, 0.12}; }

/// Points from 3 to 60 m, measured in both views with noise; `offset` is common to all disparities.
std::vector<PointMeasurement> measurements(const Pose& T_a_b, double noise, double offset, int count, Dice& dice) {
  const StereoCamera c = estimateCamera();
  std::vector<PointMeasurement> result;
  while (static_cast<int>(result.size()) < count) {
    const double z = std::exp(dice.uniform(std::log(3.0), std::log(60.0)));
    const Vector3d p = c.left.ray({dice.uniform(0.0, 511.0), dice.uniform(0.0, 383.0)}) * z;
    const bool of_a = dice.chance(0.7);
    const auto other = c.project((of_a ? T_a_b.inverse() : T_a_b) * p), own = c.project(p);
    if (!other || !own || !c.left.contains(other->head<2>())) continue;
    PointMeasurement measurement;
    measurement.of_a = of_a;
    measurement.ray = p / z;
    measurement.sigma_disparity = 0.1;
    measurement.disparity = (*own)[0] - (*own)[2] + offset + noise * measurement.sigma_disparity * dice.normal();
    measurement.covariance = 0.01 * Eigen::Matrix2d::Identity();
    measurement.pixel = other->head<2>() + noise * 0.1 * dice.normals<2>();
    if (dice.chance(0.3)) {
      measurement.other_sigma = 0.12;
      measurement.other_disparity =
          (*other)[0] - (*other)[2] + offset + noise * measurement.other_sigma * dice.normal();
    }
    result.push_back(measurement);
  }
  return result;
}

Pose motion(Dice& dice) {
  return {urban_nav_core::expSo3(0.1 * dice.normals<3>()), {0.4 * dice.normal(), 0.1 * dice.normal(), dice.normal()}};
}

TEST(Estimate, IsExactWithoutNoise) {
  Dice dice(1);
  const Pose T = motion(dice);
  EstimateOptions options;
  options.sigma_offset = 0.0;
  const Estimate found = estimate(estimateCamera(), measurements(T, 0.0, 0.0, 60, dice), Pose(), options);
  ASSERT_TRUE(found.found);
  EXPECT_TRUE(urban_nav_core::isApprox(found.T_a_b, T, 1e-7)) << found.T_a_b;
  EXPECT_EQ(found.inliers, 60);
}

TEST(Estimate, InformationIsRightWithAnErrorOfAllDisparities) {
  Dice dice(2);
  const int runs = 120;
  double mean = 0.0;
  Vector6d bias = Vector6d::Zero();
  for (int run = 0; run < runs; ++run) {
    const Pose T = motion(dice);
    const auto seen = measurements(T, 1.0, 0.1 * dice.normal(), 150, dice);
    const Estimate found = estimate(estimateCamera(), seen, Pose(), {});
    ASSERT_TRUE(found.found);
    const Vector6d d = urban_nav_core::boxMinus(T, found.T_a_b);
    mean += d.dot(found.information * d) / runs;
    bias += d / runs;
  }
  // The covariance includes correlated errors, which these measurements do not have: conservative within limits.
  EXPECT_LT(mean, 6.8);
  EXPECT_GT(mean, 2.0);
}

TEST(Estimate, OutliersDoNotMoveIt) {
  Dice dice(3);
  const Pose T = motion(dice);
  auto seen = measurements(T, 1.0, 0.0, 200, dice);
  for (std::size_t i = 0; i < 60; ++i)
    seen[i].pixel += Eigen::Vector2d(dice.uniform(5.0, 40.0), dice.uniform(-30.0, 30.0));
  const Estimate found = estimate(estimateCamera(), seen, T, {});
  ASSERT_TRUE(found.found);
  EXPECT_LT(urban_nav_core::distanceBetween(found.T_a_b, T), 0.05);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_FALSE(found.measurements[i].inlier) << i;
  EXPECT_GT(found.inliers, 130);
}

TEST(Estimate, NoiseLargerThanStatedIsDetected) {
  Dice dice(4);
  const Pose T = motion(dice);
  const Estimate as_promised = estimate(estimateCamera(), measurements(T, 1.0, 0.0, 300, dice), T, {});
  const Estimate larger = estimate(estimateCamera(), measurements(T, 3.0, 0.0, 300, dice), T, {});
  EXPECT_NEAR(larger.noise_factor, 3.0, 0.4);
  EXPECT_LT(larger.information(1, 1), 0.3 * as_promised.information(1, 1));
}

TEST(Estimate, ErrorsInCommonAreAddedToTheCovariance) {
  Dice dice(7);
  const Pose T = motion(dice);
  const auto seen = measurements(T, 1.0, 0.0, 100, dice);
  EstimateOptions options;
  const Estimate without = estimate(estimateCamera(), seen, T, options);
  options.common_px = 0.5;
  options.common_m = 0.02;
  const Estimate with = estimate(estimateCamera(), seen, T, options);
  urban_nav_core::Matrix6d expected = without.information.inverse();
  expected.topLeftCorner<3, 3>() += 0.02 * 0.02 * Eigen::Matrix3d::Identity();
  expected.bottomRightCorner<3, 3>() += std::pow(0.5 / estimateCamera().left.fx, 2) * Eigen::Matrix3d::Identity();
  EXPECT_LT((with.information * expected - urban_nav_core::Matrix6d::Identity()).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Estimate, FarPointsAloneLeaveTheTranslationOpen) {
  Dice dice(5);
  auto seen = measurements(Pose(), 0.0, 0.0, 100, dice);
  for (PointMeasurement& measurement : seen) {
    measurement.disparity = 0.02;  // 2 km
    measurement.other_sigma = 0.0;
  }
  const Estimate found = estimate(estimateCamera(), seen, Pose(), {});
  ASSERT_TRUE(found.information.allFinite());
  EXPECT_LT(found.information(0, 0), 1.0) << "1/m^2";
  EXPECT_LT(found.information(2, 2), 1.0);
  EXPECT_GT(found.information(4, 4), 1e4) << "1/rad^2";
}

TEST(Estimate, NothingOrNonsenseIsNotFound) {
  EXPECT_FALSE(estimate(estimateCamera(), {}, Pose(), {}).found);
  Dice dice(6);
  auto seen = measurements(Pose(), 1.0, 0.0, 2, dice);
  const Estimate of_two = estimate(estimateCamera(), seen, Pose(), {});
  EXPECT_FALSE(of_two.found);
  EXPECT_TRUE(of_two.T_a_b.isFinite());
}

}  // namespace
}  // namespace urban_nav_registration
