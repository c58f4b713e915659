// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/motion/up_direction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drive.hpp"
#include "urban_nav_core/motion/dead_reckoning.hpp"

namespace urban_nav_core {
namespace {

constexpr int kStepMs = 50, kForceMs = 10;

/// An `odom` whose z axis is tilted by 4 deg against the vertical.
Pose tiltedOdom() { return Pose(Quaterniond(Eigen::AngleAxisd(0.07, Vector3d(0.6, 0.8, 0.0))), Vector3d::Zero()); }

/// Forces and steps of a level drive, given in the tilted `odom`.
UpDirection followDrive(const LevelDrive& drive, double bias) {
  UpDirection up;
  for (int ms = kStepMs; ms + 1 < drive.milliseconds(); ms += kForceMs) {
    const double h = 1e-3;
    const Vector3d acceleration = (drive.at(ms + 1).t() - 2.0 * drive.at(ms).t() + drive.at(ms - 1).t()) / (h * h);
    MotionInput input;
    input.to = ms * kMillisecond;
    input.specific_force =
        drive.at(ms).q().conjugate() * Vector3d(acceleration + Vector3d(0.0, 0.0, 9.81)) + Vector3d(bias, -bias, 0.0);
    up.add(input);
    if (ms % kStepMs != 0) continue;
    up.addStep((ms - kStepMs) * kMillisecond, ms * kMillisecond, drive.between(ms - kStepMs, ms),
               (tiltedOdom() * drive.at(ms)).q(), ms > kStepMs);
  }
  return up;
}

TEST(UpDirection, IsFoundWhileTheVehicleAcceleratesAndTurns) {
  for (const double seconds : {4.0, 30.0}) {
    const UpDirection up = followDrive(LevelDrive(seconds), 0.02);
    const auto estimate = up.estimate();
    ASSERT_TRUE(estimate);
    const Vector3d exact = tiltedOdom().q() * Vector3d::UnitZ();
    const double error = std::acos(std::min(1.0, estimate->up.dot(exact)));
    EXPECT_LT(error, 3.0 * estimate->sigma) << seconds;
    EXPECT_LT(estimate->sigma, 0.02);
  }
}

TEST(UpDirection, NeedsForces) {
  EXPECT_FALSE(UpDirection().estimate());
  EXPECT_FALSE(followDrive(LevelDrive(0.5), 0.0).estimate());
  UpDirection up;
  MotionInput input;
  for (int ms = 10; ms < 5000; ms += 10) {
    input.to = ms * kMillisecond;
    input.specific_force = ms % 20 == 0 ? Vector3d(0.0, 0.0, std::numeric_limits<double>::quiet_NaN())
                                        : Vector3d(0.0, 0.0, 0.3);  // gravity removed
    up.add(input);
    if (ms % kStepMs == 0)
      up.addStep((ms - kStepMs) * kMillisecond, ms * kMillisecond, Pose(), Quaterniond::Identity(), true);
  }
  EXPECT_FALSE(up.estimate());
}

TEST(GroundSlope, IsLevelAcrossAStraightStreet) {
  // 20 m along x of a tilted `odom`: the slope along x is measured, that along y is the level's.
  const Vector3d up = tiltedOdom().q() * Vector3d::UnitZ();
  const Eigen::Vector2d exact(-up.x() / up.z(), -up.y() / up.z());
  GroundSlope slope;
  for (int i = 0; i < 200; ++i) slope.learn(Vector3d(0.1, 0.0, 0.1 * exact.x()), 1e-6);
  EXPECT_NEAR(slope.mean.x(), exact.x(), 0.01);
  EXPECT_GT(std::abs(slope.mean.y() - exact.y()), 0.03);
  const GroundSlope levelled = slope.levelled(up, 0.01);
  EXPECT_NEAR(levelled.mean.x(), exact.x(), 0.01);
  EXPECT_NEAR(levelled.mean.y(), exact.y(), 0.01);
  EXPECT_LT(levelled.covariance(1, 1), 0.2 * slope.covariance(1, 1));
  EXPECT_GE(levelled.covariance(0, 0), 0.0);
}

}  // namespace
}  // namespace urban_nav_core
