// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/fix_comparison.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

namespace urban_nav_trust {
namespace {

constexpr double kFixCorrelation = 180.0;  // s
constexpr double kFixSigma = 2.5;          // m, of a fix on each axis
constexpr double kFixAlarm = 1e-5;

/// A drive around blocks of 60 m at 1.2 m/s with a fix each second, whose errors are a Gauss-Markov process and noise,
/// together kFixSigma, in axes that are turned and shifted relative to the map.
class DriveWithGps {
 public:
  explicit DriveWithGps(unsigned seed) : random_(seed) {}
  std::vector<ComparedFix> drive(int seconds, double scale = 1.0) {
    const double slow = 0.9 * kFixSigma, noise = std::sqrt(1.0 - 0.81) * kFixSigma,
                 keep = std::exp(-1.0 / kFixCorrelation);
    Eigen::Vector2d error(slow * normal_(random_), slow * normal_(random_));
    const Eigen::Rotation2Dd turn(1.1 + normal_(random_));
    std::vector<ComparedFix> fixes;
    for (int t = 0; t < seconds; ++t) {
      const double side = 60.0, s = std::fmod(1.2 * t, 4.0 * side), along = std::fmod(s, side);
      const int edge = static_cast<int>(s / side);
      const Eigen::Vector2d corner[] = {{0, 0}, {side, 0}, {side, side}, {0, side}},
                            heading[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
      const Eigen::Vector2d truth = corner[edge] + along * heading[edge];
      for (int k = 0; k < 2; ++k) error[k] = keep * error[k] + std::sqrt(1.0 - keep * keep) * slow * normal_(random_);
      ComparedFix fix;
      fix.stamp = t * 1'000'000'000LL;
      fix.by_map = scale * truth;
      fix.by_gps = turn * truth + Eigen::Vector2d(400.0, -90.0) + error +
                   noise * Eigen::Vector2d(normal_(random_), normal_(random_));
      fix.sigma = {kFixSigma, kFixSigma};
      fix.covariance = 1e-4 * t * Eigen::Matrix2d::Identity();
      fixes.push_back(fix);
    }
    return fixes;
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
};

ConsistencyTest testDriveWithGps(const std::vector<ComparedFix>& fixes, bool is_level = true) {
  TestResults results;
  testFixes(fixes, {kFixCorrelation, is_level}, results);
  EXPECT_EQ(results.tests.size(), 1U);
  return results.tests.empty() ? ConsistencyTest() : results.tests[0];
}

TEST(FixComparison, PValuesOfSoundPathsAreAtLeastUniform) {
  for (const int seconds : {30, 200, 900, 3600}) {
    int below_tenth = 0, below_hundredth = 0;
    constexpr int kDrives = 100;
    for (unsigned seed = 1; seed <= kDrives; ++seed) {
      const double p = testDriveWithGps(DriveWithGps(seed).drive(seconds)).p_value;
      below_tenth += p < 0.1 ? 1 : 0;
      below_hundredth += p < 0.01 ? 1 : 0;
      EXPECT_GT(p, kFixAlarm) << seconds << ", " << seed;
    }
    EXPECT_LE(below_tenth, 18) << seconds;     // 99 % of a binomial variable with 0.1
    EXPECT_LE(below_hundredth, 4) << seconds;  // and with 0.01
  }
}

TEST(FixComparison, ALongWrongPathFailsAndIsNamedAsImplausible) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ConsistencyTest test = testDriveWithGps(DriveWithGps(seed).drive(900, 1.4));
    EXPECT_EQ(test.degrees_of_freedom, 3.0);
    EXPECT_LT(test.p_value, kFixAlarm) << seed;
    EXPECT_NE(test.sentence.find("path is implausible"), std::string::npos) << test.sentence;
    EXPECT_FALSE(test.remedy.empty());
  }
}

TEST(FixComparison, MultipathIsAnErrorOfGpsAndNoFaultOfTheMap) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::vector<ComparedFix> fixes = DriveWithGps(seed).drive(900);
    const double away = 20.0 + seed;
    for (std::size_t i = 300; i < 640; ++i) fixes[i].by_gps.x() += away;  // near a facade
    const ConsistencyTest test = testDriveWithGps(fixes);
    EXPECT_GT(test.p_value, kFixAlarm) << seed;
    EXPECT_NE(test.sentence.find("multipath"), std::string::npos) << test.sentence;
  }
}

TEST(FixComparison, AReceiverThatStatesTooSmallErrorsIsNoFaultOfTheMap) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::vector<ComparedFix> fixes = DriveWithGps(seed).drive(600);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 4.0 * kFixSigma);
    for (ComparedFix& fix : fixes) fix.by_gps += Eigen::Vector2d(normal(random), normal(random));
    EXPECT_GT(testDriveWithGps(fixes).p_value, kFixAlarm) << seed;
  }
}

TEST(FixComparison, AnUncertainPathIsNotContradicted) {
  std::vector<ComparedFix> fixes = DriveWithGps(4).drive(900, 1.4);
  for (ComparedFix& fix : fixes) fix.covariance = 400.0 * Eigen::Matrix2d::Identity();
  EXPECT_GT(testDriveWithGps(fixes).p_value, kFixAlarm);
}

TEST(FixComparison, LengthsInAMapThatMayBeTiltedAreLessCertain) {
  const std::vector<ComparedFix> fixes = DriveWithGps(5).drive(900, 1.1);
  EXPECT_GE(testDriveWithGps(fixes, false).p_value, testDriveWithGps(fixes, true).p_value);
}

TEST(FixComparison, WithoutEnoughFixesItIsAbsentWithTheReason) {
  TestResults results;
  testFixes({}, {}, results);
  std::vector<ComparedFix> fixes = DriveWithGps(6).drive(8);
  testFixes(fixes, {}, results);
  fixes = DriveWithGps(6).drive(60);
  for (ComparedFix& fix : fixes) fix.by_gps.x() = std::numeric_limits<double>::quiet_NaN();
  testFixes(fixes, {}, results);
  EXPECT_TRUE(results.tests.empty());
  ASSERT_EQ(results.absent.size(), 3U);
  for (const AbsentMeasurement& absent : results.absent) {
    EXPECT_EQ(absent.name, kFixTest);
    EXPECT_FALSE(absent.reason.empty());
  }
}

TEST(FixComparison, AStationaryRobotIsConsistent) {
  std::vector<ComparedFix> fixes = DriveWithGps(7).drive(120);
  for (ComparedFix& fix : fixes) {
    fix.by_gps = fix.by_gps - fixes.front().by_gps;
    fix.by_map = Eigen::Vector2d::Zero();
    fix.by_gps = 0.01 * fix.by_gps;
  }
  const ConsistencyTest test = testDriveWithGps(fixes);
  EXPECT_TRUE(std::isfinite(test.statistic));
  EXPECT_GT(test.p_value, kFixAlarm);
}

}  // namespace
}  // namespace urban_nav_trust
