// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/session_comparisons.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace urban_nav_trust {
namespace {

constexpr double kDegree = M_PI / 180.0;

UpEstimate tilted(double pitch, double roll, double sigma) {
  UpEstimate estimate;
  estimate.up = Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()) *
                Eigen::Vector3d::UnitZ();
  estimate.covariance = sigma * sigma * (Eigen::Matrix3d::Identity() - estimate.up * estimate.up.transpose());
  return estimate;
}

TEST(SessionComparisons, GroundAndGravityFailAsOftenAsStated) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 1.0);
  const double ground = 0.8 * kDegree, gravity = 0.1 * kDegree;
  int below = 0;
  constexpr int kRuns = 1000;
  for (int i = 0; i < kRuns; ++i) {
    TestResults results;
    testGravity(tilted(ground * normal(random), ground * normal(random), ground),
                tilted(gravity * normal(random), gravity * normal(random), gravity), {1, 2}, "", results);
    ASSERT_EQ(results.tests.size(), 1U);
    below += results.tests[0].p_value < 0.1 ? 1 : 0;
  }
  EXPECT_NEAR(below, 100, 35);
}

TEST(SessionComparisons, AnImuThatIsMountedTiltedFails) {
  TestResults results;
  testGravity(tilted(6.0 * kDegree, 0.0, 0.8 * kDegree), tilted(0.0, 0.0, 0.1 * kDegree), {1, 2}, "", results);
  ASSERT_EQ(results.tests.size(), 1U);
  EXPECT_LT(results.tests[0].p_value, 1e-5);
  EXPECT_NE(results.tests[0].sentence.find("6 deg"), std::string::npos) << results.tests[0].sentence;
  TestResults absent;
  testGravity(std::nullopt, tilted(0.0, 0.0, 0.01), {1, 2}, "no ground", absent);
  ASSERT_EQ(absent.absent.size(), 1U);
  EXPECT_EQ(absent.absent[0].reason, "no ground");
}

LidarComparison agreeing() {
  LidarComparison comparison;
  comparison.interval = {0, 30'000'000'000};
  comparison.stretches = 30;
  comparison.scale_sigma = 1e-3;
  return comparison;
}

TEST(SessionComparisons, StereoAndLidarThatAgreeConfirmTheCovariance) {
  LidarComparison comparison = agreeing();
  for (const double spread : {1.0, 8.0, 40.0}) {  // 8: measured on 27 m of KITTI
    comparison.spread = spread;
    TestResults results;
    testLidar(comparison, 5e-4, results);
    ASSERT_EQ(results.tests.size(), 2U);
    for (const ConsistencyTest& test : results.tests) EXPECT_GT(test.p_value, 1e-3) << test.name;
    EXPECT_TRUE(confirm(results).isComplete());
    EXPECT_GT(confirm(results).scales[0], 0.9);
  }
}

TEST(SessionComparisons, AContradictionAndAWrongScaleFail) {
  LidarComparison comparison = agreeing();
  comparison.contradictions = 1;
  comparison.largest = 30'000.0;
  comparison.worst = {5, 6};
  comparison.scale = -0.01;
  TestResults results;
  testLidar(comparison, 5e-4, results);
  ASSERT_EQ(results.tests.size(), 2U);
  EXPECT_EQ(results.tests[0].name, kLidarTest);
  EXPECT_LT(results.tests[0].p_value, 1e-5);
  EXPECT_EQ(results.tests[0].interval.from, 5);
  EXPECT_EQ(results.tests[1].name, kLidarScaleTest);
  EXPECT_LT(results.tests[1].p_value, 1e-5);
  EXPECT_NE(results.tests[1].remedy.find("0.99"), std::string::npos) << results.tests[1].remedy;
}

TEST(SessionComparisons, WithoutALidarBothAreAbsent) {
  TestResults results;
  testLidar(std::nullopt, 5e-4, results);
  EXPECT_TRUE(results.tests.empty());
  EXPECT_EQ(results.absent.size(), 2U);
  EXPECT_TRUE(results.turns.isEmpty());
}

}  // namespace
}  // namespace urban_nav_trust
