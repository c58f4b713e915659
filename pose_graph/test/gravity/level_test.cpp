// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/level.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../support/specific_force_drive.hpp"
#include "urban_nav_core/testing/bands.hpp"

namespace pose_graph {
namespace {

using Eigen::Vector3d;
using testing::Drive;
using testing::kGravity;
using testing::kStepNs;
using urban_nav_core::expSo3;
using urban_nav_core::Matrix3d;
using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_core::testing::Dice;

double degreesBetween(const Vector3d& a, const Vector3d& b) { return std::asin(a.cross(b).norm()) * 180.0 / M_PI; }

TEST(Level, IsExactWhereNothingIsWrong) {
  Dice dice(1);
  const Drive drive;
  const Level level = drive.level(dice);
  ASSERT_TRUE(level.known()) << level.sentence;
  EXPECT_LT(degreesBetween(level.up, drive.trueUp()), 0.01) << "what sums over frames leave";
  EXPECT_NEAR(level.gravity, kGravity, 1e-3);
}

TEST(Level, MapIsLevelWithTheHeadingOfTheFirstPose) {
  Dice dice(1);
  const Drive drive;
  const Level level = drive.level(dice);
  EXPECT_LT((level.R_map_first * level.up - Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((level.R_map_first * level.R_map_first.transpose() - Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(level.R_map_first.determinant(), 1.0, 1e-12);
  const Vector3d ahead = level.R_map_first * Vector3d::UnitX();
  EXPECT_NEAR(ahead.y(), 0.0, 1e-12);
  EXPECT_GT(ahead.x(), 0.9);
}

TEST(Level, SeparatesBiasFromTiltWhereTheRobotTurns) {
  Dice dice(1);
  Drive drive;
  drive.fault = {0.1, -0.15, 0.05};
  drive.noise = 0.02;
  Level level = drive.level(dice);
  ASSERT_TRUE(level.known());
  EXPECT_LT(degreesBetween(level.up, drive.trueUp()), 0.05);
  EXPECT_LT(level.sigma, 0.05 * M_PI / 180.0);
  drive.turning = drive.rocking = 0.0;
  level = drive.level(dice);
  ASSERT_TRUE(level.known());
  const double error = degreesBetween(level.up, drive.trueUp());
  EXPECT_GT(error, 0.5) << "nothing could tell";
  EXPECT_LT(error, 3.0 * level.sigma * 180.0 / M_PI) << "and it says so";
}

TEST(Level, DoesNotDependOnTheFrameOfTheTrajectory) {
  Dice dice(1);
  const Drive drive;
  const std::vector<SpecificForce> forces = drive.forces(dice);
  const Pose T_elsewhere(expSo3(Vector3d(1.0, 2.0, -0.5)), Vector3d(100.0, -30.0, 7.0));
  const Level level = estimateLevel(drive.trajectory(), forces),
              same = estimateLevel(transformed(T_elsewhere, drive.trajectory()), forces);
  EXPECT_LT((level.up - same.up).norm(), 1e-9);
  const Pose later = drive.trajectory()[700].pose;
  const Level from_later = estimateLevel(drive.trajectory(), forces, later);
  EXPECT_LT((later.R().transpose() * level.up - from_later.up).norm(), 1e-9);
}

TEST(Level, ToleratesShocksAndInvalidForces) {
  Dice dice(3);
  Drive drive;
  drive.noise = 0.05;
  std::vector<SpecificForce> forces = drive.forces(dice);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (i >= 400 && i < 600) forces[i].force += Vector3d(3.0, -2.0, 5.0);  // ten seconds of a wrong calibration
    if (dice.chance(0.005)) forces[i].force = 40.0 * dice.normals<3>();
    if (dice.chance(0.01)) forces[i].force.y() = std::numeric_limits<double>::quiet_NaN();
    if (dice.chance(0.001)) forces[i].force *= 1e300;
  }
  const Level level = estimateLevel(drive.trajectory(), forces);
  ASSERT_TRUE(level.known()) << level.sentence;
  EXPECT_LT(degreesBetween(level.up, drive.trueUp()), 0.15);
  EXPECT_TRUE(level.covariance.allFinite());
}

TEST(Level, ItsCovarianceIsRight) {
  Dice dice(7);
  double sum = 0.0;
  constexpr int kDrives = 100;
  for (int i = 0; i < kDrives; ++i) {
    Drive drive;
    drive.frames = 400;
    drive.turning = 0.05;
    drive.noise = 0.3;
    drive.fault = 9.81 * 0.01745 * dice.normals<3>();
    drive.fault.z() *= 0.1;
    const Level level = drive.level(dice);
    ASSERT_TRUE(level.known());
    // In the plane perpendicular to `up`, where the covariance is regular.
    const Matrix3d axes = level.R_map_first;
    const Eigen::Vector2d error = (axes * (level.up - drive.trueUp())).head<2>();
    const Eigen::Matrix2d covariance = (axes * level.covariance * axes.transpose()).topLeftCorner<2, 2>();
    sum += error.dot(covariance.inverse() * error);
  }
  // Ten spans determine the scatter of their noise to a quarter only: the interval is that of 30 drives.
  EXPECT_TRUE(urban_nav_core::testing::meanChiSquareFits(sum / kDrives, 2, 30));
}

TEST(Level, IsEstimatedFromAFewSeconds) {
  Dice dice(11);
  for (const int frames : {40, 60, 100}) {
    double sum = 0.0;
    constexpr int kDrives = 200;
    for (int i = 0; i < kDrives; ++i) {
      Drive drive;
      drive.frames = frames;
      drive.noise = 0.1;
      drive.fault = 9.81 * 0.01745 * dice.normals<3>();
      drive.fault.z() *= 0.1;
      const Level level = drive.level(dice);
      ASSERT_TRUE(level.known()) << level.sentence;
      EXPECT_LT(degreesBetween(level.up, drive.trueUp()), 6.0);
      const Eigen::Vector2d error = (level.R_map_first * (level.up - drive.trueUp())).head<2>();
      const Eigen::Matrix2d covariance =
          (level.R_map_first * level.covariance * level.R_map_first.transpose()).topLeftCorner<2, 2>();
      sum += error.dot(covariance.inverse() * error);
    }
    EXPECT_TRUE(urban_nav_core::testing::meanChiSquareFits(sum / kDrives, 2, 30)) << frames;
  }
}

TEST(Level, RotationsThatAreNotExactAddToItsCovariance) {
  Dice dice(1);
  const Level level = Drive().level(dice);
  const Level same = withRotations(level, Matrix3d::Zero());
  EXPECT_EQ(same.covariance, level.covariance);
  // The heading is the least certain and has no effect.
  const Matrix3d covariance = Vector3d(1e-4, 4e-4, 1.0).asDiagonal();
  const Level wider = withRotations(level, covariance);
  // A rotation by phi moves `up` by phi x up.
  Matrix3d sum = level.covariance;
  for (int i = 0; i < 3; ++i) {
    const Vector3d moved = (Vector3d::Unit(i) * std::sqrt(covariance(i, i))).cross(level.up);
    sum += moved * moved.transpose();
  }
  EXPECT_LT((wider.covariance - sum).norm(), 1e-12);
  EXPECT_GT(wider.sigma, 0.01);
  EXPECT_EQ(wider.up, level.up);
  EXPECT_FALSE(withRotations(Level(), covariance).known());
}

TEST(Level, ReportsWhyItIsUnknown) {
  Dice dice(1);
  Drive drive;
  EXPECT_EQ(estimateLevel(drive.trajectory(), {}).trouble, LevelTrouble::NoForces);
  EXPECT_EQ(estimateLevel({}, drive.forces(dice)).trouble, LevelTrouble::NoForces);
  std::vector<SpecificForce> forces = drive.forces(dice);
  for (SpecificForce& sample : forces) sample.stamp += 1;
  EXPECT_EQ(estimateLevel(drive.trajectory(), forces).trouble, LevelTrouble::TooShort) << "of no pose";
  forces = drive.forces(dice);
  for (SpecificForce& sample : forces) sample.force /= kGravity;
  const Level level = estimateLevel(drive.trajectory(), forces);
  EXPECT_EQ(level.trouble, LevelTrouble::NotGravity) << "in units of g";
  EXPECT_FALSE(level.sentence.empty());
  EXPECT_TRUE(level.R_map_first.isIdentity());
  drive.frames = 25;
  EXPECT_EQ(drive.level(dice).trouble, LevelTrouble::TooShort);
  for (const LevelTrouble trouble :
       {LevelTrouble::None, LevelTrouble::NoForces, LevelTrouble::TooShort, LevelTrouble::NotGravity})
    EXPECT_STRNE(toString(trouble), "");
}

}  // namespace
}  // namespace pose_graph
