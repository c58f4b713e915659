// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "laser_odometry/laser_odometry.hpp"
#include "support/spinning_lidar.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace laser_odometry {
namespace {

using urban_nav_core::Health;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A drive in which sweeps 5 and 6 of 12 are altered. Checks that every result is finite and its covariance valid.
std::vector<LaserPose> driveWith(const std::function<void(Sweep&)>& alter, double tolerance = 0.05) {
  const SpinningLidar lidar;
  const BoxWorld world = makeStreet(8);
  const auto motion = makeDrive(5.0, 0.1);
  LaserOdometry odometry({}, lidar.T_base_lidar);
  std::vector<LaserPose> poses;
  for (int i = 0; i < 12; ++i) {
    Sweep sweep = lidar.scan(world, motion, 0.1 * i, 1);
    if (i == 5 || i == 6) alter(sweep);
    poses.push_back(odometry.process(sweep));
    const LaserPose& pose = poses.back();
    EXPECT_TRUE(pose.T_odom_base.isFinite());
    EXPECT_TRUE(pose.step.covariance.allFinite() && pose.step.drift_covariance.allFinite());
    if (!pose.accepted) continue;
    const auto values = urban_nav_core::symmetricEigenvalues(pose.step.covariance);
    EXPECT_TRUE(values && (*values)[0] > 0.0);
  }
  const Pose truth = motion(0.0).inverse() * motion(1.1);
  EXPECT_LT((poses.back().T_odom_base.t() - truth.t()).norm(), tolerance);
  return poses;
}

void expectReason(const LaserPose& pose, Health health, Reason reason) {
  EXPECT_EQ(pose.status.health, health) << pose.status;
  EXPECT_EQ(pose.status.reason, static_cast<int>(reason)) << pose.status;
  EXPECT_FALSE(pose.status.sentence.empty());
}

TEST(BadSweeps, AllNanIsLostAndThenRecovered) {
  const auto poses = driveWith([](Sweep& sweep) {
    for (auto& beam : sweep.beams) beam.range = kNan;
  });
  expectReason(poses[5], Health::Lost, Reason::NoPoints);
  expectReason(poses[6], Health::Lost, Reason::NoPoints);
  EXPECT_EQ(poses[7].status.health, Health::Recovered);
  EXPECT_EQ(poses[8].status.health, Health::Ok);
  EXPECT_GT(poses[5].step.covariance(0, 0), 100.0 * poses[4].step.covariance(0, 0));
}

TEST(BadSweeps, EmptyAndFivePointsAreLost) {
  const auto empty = driveWith([](Sweep& sweep) { sweep.beams.clear(); });
  expectReason(empty[5], Health::Lost, Reason::NoPoints);
  const auto five = driveWith([](Sweep& sweep) { sweep.beams.resize(5); });
  expectReason(five[5], Health::Lost, Reason::TooFewPoints);
}

TEST(BadSweeps, AnEarlierReferenceIsDropped) {
  const auto poses = driveWith([](Sweep& sweep) { sweep.reference -= 1000000000; });
  expectReason(poses[5], Health::Degraded, Reason::BadStamp);
  EXPECT_FALSE(poses[5].accepted);
  EXPECT_EQ(poses[5].T_odom_base.matrix(), poses[4].T_odom_base.matrix());
  EXPECT_EQ(poses[7].step.from, poses[4].stamp);  // the chain has no gap
}

TEST(BadSweeps, TimesThatDecreaseOrAreAbsurdAreNotFatal) {
  driveWith(
      [](Sweep& sweep) {
        for (auto& beam : sweep.beams) beam.stamp = 2 * sweep.reference - beam.stamp;
        std::reverse(sweep.beams.begin(), sweep.beams.end());
      },
      0.15);
  const auto poses = driveWith([](Sweep& sweep) {
    for (auto& beam : sweep.beams) beam.stamp = std::numeric_limits<StampNs>::max();
  });
  EXPECT_EQ(poses[5].status.health, Health::Lost);
}

TEST(BadSweeps, InfiniteAndHugeValuesAreLeftOut) {
  driveWith([](Sweep& sweep) {
    for (std::size_t i = 0; i < sweep.beams.size(); i += 2) {
      sweep.beams[i].range = i % 4 == 0 ? std::numeric_limits<float>::infinity() : 1e30F;
      if (i % 8 == 0) sweep.beams[i].direction.x() = kNan;
    }
  });
}

TEST(BadSweeps, ACoverOverHalfOfTheSensorIsNamed) {
  const auto poses = driveWith([](Sweep& sweep) {
    for (auto& beam : sweep.beams)
      if (beam.direction.y() > 0.0F) beam.range = 0.4F;
  });
  expectReason(poses[5], Health::Degraded, Reason::Covered);
}

TEST(BadSweeps, AGapIsNamedAndBridged) {
  const SpinningLidar lidar;
  const BoxWorld world = makeStreet(9);
  const auto motion = makeDrive(5.0, 0.0);
  LaserOdometry odometry({}, lidar.T_base_lidar);
  LaserPose pose;
  for (const int i : {0, 1, 2, 3, 4, 8}) pose = odometry.process(lidar.scan(world, motion, 0.1 * i, 1));
  EXPECT_EQ(pose.status.reason, static_cast<int>(Reason::Gap)) << pose.status;
  EXPECT_NEAR(pose.T_odom_base.t().x(), 4.0, 0.02);
}

TEST(BadSweeps, OverlappingSweepsAreNamed) {
  SpinningLidar lidar;
  lidar.sweep_s = 0.2;
  LaserOdometry odometry({}, lidar.T_base_lidar);
  LaserPose pose;
  for (int i = 0; i < 4; ++i) pose = odometry.process(lidar.scan(makeRoom(), makeDrive(0.2, 0.0), 0.1 * i, 1));
  EXPECT_EQ(pose.status.reason, static_cast<int>(Reason::Overlap)) << pose.status;
}

TEST(BadSweeps, SweepsOfAnotherPlaceBeginANewMap) {
  const SpinningLidar lidar;
  LaserOdometry odometry({}, lidar.T_base_lidar);
  for (int i = 0; i < 5; ++i) odometry.process(lidar.scan(makeStreet(1), makeDrive(0.0, 0.0), 0.1 * i, 1));
  LaserPose pose;
  for (int i = 5; i < 20; ++i) pose = odometry.process(lidar.scan(makeRoom(), makeDrive(0.0, 0.0), 0.1 * i, 1));
  EXPECT_EQ(pose.status.health, Health::Ok) << pose.status;
}

}  // namespace
}  // namespace laser_odometry
