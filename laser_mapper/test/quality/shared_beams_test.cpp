// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/shared_beams.hpp"

#include <gtest/gtest.h>

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;

constexpr StampNs kSecond = 1'000'000'000, kDriveBegin = 1'225'719'872 * kSecond;

/// Along x at 1 m/s for 100 s: stretch n is from 4 n to 4 n + 4 m.
Trajectory driveStraight() {
  Trajectory trajectory;
  for (int i = 0; i <= 1000; ++i)
    trajectory.append(kDriveBegin + i * kSecond / 10,
                      Pose(Eigen::Quaterniond::Identity(), Vector3d(0.1 * i, 0.0, 0.0)));
  return trajectory;
}

PlaneConstraint constraintBetween(std::int64_t stretch_a, std::int64_t stretch_b, std::size_t session_b = 0) {
  PlaneConstraint constraint;
  constraint.stretch_a = stretch_a;
  constraint.stretch_b = stretch_b;
  constraint.session_b = session_b;
  return constraint;
}

TEST(SharedBeamsTest, StretchesNearBothEndsOfAClosureAreUsed) {
  const Trajectory trajectory = driveStraight();
  const SharedBeams beams({&trajectory}, {{0, 0, kDriveBegin + 20 * kSecond, kDriveBegin + 80 * kSecond}}, 10.0);
  EXPECT_TRUE(beams.areUsedBy(constraintBetween(5, 20)));
  EXPECT_TRUE(beams.areUsedBy(constraintBetween(20, 5))) << "in either order";
  EXPECT_TRUE(beams.areUsedBy(constraintBetween(7, 22))) << "28 to 32 m, of a cloud that ends at 30 m";
  EXPECT_FALSE(beams.areUsedBy(constraintBetween(8, 20))) << "beyond the first cloud";
  EXPECT_FALSE(beams.areUsedBy(constraintBetween(5, 6))) << "both in the first cloud";
  EXPECT_FALSE(beams.areUsedBy(constraintBetween(1, 12))) << "nowhere near";
  EXPECT_FALSE(SharedBeams({&trajectory}, {}, 10.0).areUsedBy(constraintBetween(5, 20)));
}

TEST(SharedBeamsTest, SessionsAreToldApart) {
  const Trajectory monday = driveStraight(), tuesday = driveStraight();
  const SharedBeams beams({&monday, &tuesday}, {{0, 1, kDriveBegin + 20 * kSecond, kDriveBegin + 80 * kSecond}}, 10.0);
  EXPECT_TRUE(beams.areUsedBy(constraintBetween(5, 20, 1)));
  EXPECT_FALSE(beams.areUsedBy(constraintBetween(20, 5, 1)));
  EXPECT_FALSE(beams.areUsedBy(constraintBetween(5, 20, 0)));
}

TEST(SharedBeamsTest, TheLengthOfThePathCountsNotTheTime) {
  Trajectory waiting = driveStraight();
  for (int i = 1; i <= 100; ++i)
    waiting.append(kDriveBegin + (100 + i) * kSecond, waiting.back().pose);  // 100 s at 100 m
  const SharedBeams beams({&waiting}, {{0, 0, kDriveBegin + 20 * kSecond, kDriveBegin + 190 * kSecond}}, 10.0);
  EXPECT_TRUE(beams.areUsedBy(constraintBetween(5, 23))) << "92 to 96 m";
  EXPECT_FALSE(beams.areUsedBy(constraintBetween(5, 21))) << "84 to 88 m";
}

}  // namespace
}  // namespace laser_mapper
