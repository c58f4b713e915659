// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/laser_mounting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace urban_nav_trust {
namespace {

constexpr double kTestDegree = M_PI / 180.0;
constexpr double kTestFalseAlarm = 1e-5;

/// Corridor of a robot with a laser on either side, whose surfaces are displaced as if each laser had turned by its
/// angle. The displacement is computed from rotated beams, not from levers.
struct Corridor {
  double left = 0.0, right = 0.0, head = 0.0;  // rad, from keyframe `from` on
  std::size_t from = 0, keyframes = 40;
  double noise = 0.03;
  unsigned seed = 1;

  std::vector<KeyframeMatches> drive() const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<KeyframeMatches> result(keyframes);
    for (std::size_t k = 0; k < keyframes; ++k) {
      result[k].stamp = static_cast<urban_nav_core::StampNs>(k) * 1'000'000'000;
      const double common = 0.005 * normal(random);
      for (int i = 0; i < 120; ++i) {
        const int laser = i % 2;
        const double side = laser == 0 ? 1.0 : -1.0, angle = k >= from ? (laser == 0 ? left : right) : 0.0;
        const bool is_wall = i % 3 == 0;
        // Seen from the laser, in its scan plane: x to the side, y upwards.
        const Eigen::Vector2d p = is_wall ? Eigen::Vector2d(side * 3.0, 2.0 * unit(random) - 1.0)
                                          : Eigen::Vector2d(side * (0.5 + 2.0 * unit(random)), -1.0);
        const Eigen::Vector2d normal2 = is_wall ? Eigen::Vector2d(-side, 0.0) : Eigen::Vector2d(0.0, 1.0);
        const auto turned = [&](double by) {
          return Eigen::Vector2d(std::cos(by) * p.x() - std::sin(by) * p.y(),
                                 std::sin(by) * p.x() + std::cos(by) * p.y());
        };
        SurfaceMatch match;
        match.laser = laser;
        match.normal = Eigen::Vector3d(0.0, normal2.x(), normal2.y());
        match.lever = normal2.x() * -p.y() + normal2.y() * p.x();
        const double by_head = k >= from ? head : 0.0;
        match.excess = normal2.dot(turned(by_head) - turned(angle)) + common + noise * normal(random);
        match.sigma = 0.01;
        result[k].matches.push_back(match);
      }
    }
    return result;
  }
};

ConsistencyTest testCorridor(const Corridor& corridor) {
  std::vector<ConsistencyTest> tests;
  std::vector<AbsentMeasurement> absent;
  testLaserMountings(corridor.drive(), {"laser_left", "laser_right"}, kTestFalseAlarm, tests, absent);
  EXPECT_EQ(tests.size(), 1U);
  EXPECT_TRUE(absent.empty());
  return tests.at(0);
}

TEST(LaserMounting, TheAngleIsThatOfTheTurnedLaser) {
  Corridor corridor;
  corridor.left = 2.0 * kTestDegree;
  const std::vector<KeyframeMatches> keyframes = corridor.drive();
  double left = 0.0, right = 0.0;
  for (const LaserAngle& each : laserAngles(keyframes, 0)) left += each.angle / 40.0;
  for (const LaserAngle& each : laserAngles(keyframes, 1)) right += each.angle / 40.0;
  EXPECT_NEAR(left, 2.0 * kTestDegree, 0.1 * kTestDegree);
  EXPECT_NEAR(right, 0.0, 0.1 * kTestDegree);
}

TEST(LaserMounting, PassesInFiftyUnchangedDrives) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    Corridor corridor;
    corridor.seed = seed;
    corridor.left = 0.4 * kTestDegree;  // a constant within the accuracy of a measured mounting
    EXPECT_GT(testCorridor(corridor).p_value, 1e-3) << seed;
  }
}

TEST(LaserMounting, NamesTheLaserThatTurnsAndWhen) {
  Corridor corridor;
  corridor.from = 20;
  corridor.right = -1.5 * kTestDegree;
  const ConsistencyTest test = testCorridor(corridor);
  EXPECT_LT(test.p_value, kTestFalseAlarm);
  EXPECT_NE(test.sentence.find("laser_right"), std::string::npos);
  EXPECT_NEAR(1e-9 * static_cast<double>(test.interval.from), 20.0, 1.5);
}

TEST(LaserMounting, ALaserTurnedFromTheStartIsOffItsMounting) {
  Corridor corridor;
  corridor.left = 5.0 * kTestDegree;
  const ConsistencyTest test = testCorridor(corridor);
  EXPECT_LT(test.p_value, kTestFalseAlarm);
  EXPECT_NE(test.sentence.find("off its stated mounting"), std::string::npos);
}

TEST(LaserMounting, BothLasersTogetherAreTheHead) {
  Corridor corridor;
  corridor.from = 20;
  corridor.head = 1.5 * kTestDegree;
  const ConsistencyTest test = testCorridor(corridor);
  EXPECT_LT(test.p_value, kTestFalseAlarm);
  EXPECT_NE(test.remedy.find("stereo head"), std::string::npos);
}

TEST(LaserMounting, WithoutMatchesItIsAbsentWithAReason) {
  std::vector<ConsistencyTest> tests;
  std::vector<AbsentMeasurement> absent;
  testLaserMountings({}, {"laser_left"}, kTestFalseAlarm, tests, absent);
  Corridor few;
  few.keyframes = 5;
  testLaserMountings(few.drive(), {"laser_left", "laser_right"}, kTestFalseAlarm, tests, absent);
  EXPECT_TRUE(tests.empty());
  ASSERT_EQ(absent.size(), 2U);
  EXPECT_NE(absent[0].reason, absent[1].reason);
}

}  // namespace
}  // namespace urban_nav_trust
