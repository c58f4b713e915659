// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/depth_comparison.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace urban_nav_trust {
namespace {

/// Keyframes between walls and above ground, with stereo points whose lengths are too long by `scale`.
std::vector<KeyframeMatches> drive(unsigned seed, double scale, double noise, double yaw = 0.0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::uniform_real_distribution<double> ahead(1.0, 8.0), aside(2.0, 6.0);
  std::vector<KeyframeMatches> keyframes(40);
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    keyframes[k].stamp = static_cast<urban_nav_core::StampNs>(k) * 1'000'000'000;
    const double common = 0.3 * noise * normal(random), left = aside(random), right = aside(random);
    for (int i = 0; i < 90; ++i) {
      SurfaceMatch match;
      const Eigen::Vector3d p(ahead(random),
                              i % 3 == 0   ? left
                              : i % 3 == 1 ? -right
                                           : 0.5 * normal(random),
                              i % 3 == 2 ? -1.0 : 0.5 * normal(random));
      match.normal = i % 3 == 0   ? Eigen::Vector3d(0.0, -1.0, 0.0)
                     : i % 3 == 1 ? Eigen::Vector3d(0.0, 1.0, 0.0)
                                  : Eigen::Vector3d::UnitZ();
      const Eigen::Vector3d turned = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * ((1.0 + scale) * p);
      match.p = turned + (common + noise * normal(random)) * match.normal;
      match.excess = match.normal.dot(match.p - p);
      keyframes[k].matches.push_back(match);
    }
  }
  return keyframes;
}

TEST(DepthComparison, TheScaleIsExactWithoutNoise) {
  const DepthScale found = estimateDepthScale(drive(1, 0.01, 0.0));
  EXPECT_NEAR(found.scale, 0.01, 2e-4);  // p is too long by the scale, and the priors of the mounting bias the estimate
  EXPECT_EQ(found.keyframes, 40U);
}

// Noise along the line of sight increases n . p together with the excess: with p instead of the surface's point, walls
// at 2 m with a noise of 0.1 m would give a scale of 0.0025.
TEST(DepthComparison, NoiseOfStereoIsNoScale) {
  double sum = 0.0;
  const int runs = 100;
  for (unsigned seed = 1; seed <= runs; ++seed) sum += estimateDepthScale(drive(seed, 0.0, 0.1)).scale;
  EXPECT_NEAR(sum / runs, 0.0, 3e-4);
}

TEST(DepthComparison, ItsErrorsAreAsLargeAsStated) {
  double squares = 0.0;
  const int runs = 200;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const DepthScale found = estimateDepthScale(drive(seed, 0.0, 0.05));
    squares += std::pow(found.scale / found.sigma, 2);
    EXPECT_LT(found.sigma, 0.003);
  }
  EXPECT_NEAR(squares / runs, 1.0, 0.35);
}

TEST(DepthComparison, AWrongBaselineFailsAndATurnedHeadIsNoScale) {
  std::vector<ConsistencyTest> tests;
  std::vector<AbsentMeasurement> absent;
  testDepths(drive(3, 0.02, 0.03), 5e-4, tests, absent);
  ASSERT_EQ(tests.size(), 1U);
  EXPECT_EQ(tests[0].name, kDepthScaleTest);
  EXPECT_LT(tests[0].p_value, 1e-5);
  EXPECT_NE(tests[0].remedy.find("aseline"), std::string::npos);
  ASSERT_EQ(absent.size(), 1U);
  EXPECT_EQ(absent[0].name, kExchangeTest);
  tests.clear();
  testDepths(drive(4, 0.0, 0.03, 0.01), 5e-4, tests, absent);
  EXPECT_GT(tests[0].p_value, 1e-4);
}

TEST(DepthComparison, LasersThatFitExchangedFail) {
  std::vector<KeyframeMatches> keyframes = drive(5, 0.0, 0.03);
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    keyframes[k].points = 100;
    keyframes[k].as_stated = 60 + static_cast<int>(k % 7);
    keyframes[k].exchanged = 10 + static_cast<int>(k % 5);
  }
  std::vector<ConsistencyTest> tests;
  std::vector<AbsentMeasurement> absent;
  testDepths(keyframes, 5e-4, tests, absent);
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_GT(tests[1].p_value, 0.5);
  for (KeyframeMatches& keyframe : keyframes) std::swap(keyframe.as_stated, keyframe.exchanged);
  tests.clear();
  testDepths(keyframes, 5e-4, tests, absent);
  EXPECT_LT(tests[1].p_value, 1e-6);
  EXPECT_NE(tests[1].sentence.find("exchanged"), std::string::npos);
}

TEST(DepthComparison, NothingToCompareIsAbsentWithAReason) {
  std::vector<ConsistencyTest> tests;
  std::vector<AbsentMeasurement> absent;
  testDepths({}, 5e-4, tests, absent);
  EXPECT_TRUE(tests.empty());
  ASSERT_EQ(absent.size(), 2U);
  EXPECT_FALSE(absent[0].reason.empty());
}

}  // namespace
}  // namespace urban_nav_trust
