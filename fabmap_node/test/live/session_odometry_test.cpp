// SPDX-License-Identifier: BSD-3-Clause
#include "live/session_odometry.hpp"

#include <gtest/gtest.h>

namespace fabmap_node {
namespace {

using urban_nav_core::StampNs;

constexpr StampNs kPosePeriod = 1'000'000'000;

/// One pose a kPosePeriod, `speed` metres apart.
void drive(SessionOdometry& odometry, StampNs from, int poses, double speed) {
  for (int i = 0; i < poses; ++i)
    odometry.add({from + i * kPosePeriod, {urban_nav_core::Quaterniond::Identity(), {speed * i, 0.0, 0.0}}});
}

TEST(SessionOdometry, MeasuresTheDistanceDrivenSinceItsFirstPose) {
  SessionOdometry odometry;
  EXPECT_FALSE(odometry.start());
  drive(odometry, 100 * kPosePeriod, 11, 2.0);
  EXPECT_EQ(odometry.start(), 100 * kPosePeriod);
  EXPECT_DOUBLE_EQ(odometry.travelled(105 * kPosePeriod + kPosePeriod / 2), 11.0);
  EXPECT_FALSE(odometry.isAhead());
}

TEST(SessionOdometry, KeepsTheSessionUntilObservationsJumpBackAsWell) {
  SessionOdometry odometry;
  drive(odometry, 100 * kPosePeriod, 11, 2.0);
  drive(odometry, 50 * kPosePeriod, 5, 1.0);
  EXPECT_TRUE(odometry.isAhead());
  EXPECT_EQ(odometry.start(), 100 * kPosePeriod);
  EXPECT_DOUBLE_EQ(odometry.travelled(110 * kPosePeriod), 20.0) << "for the last observation of the session";
  odometry.beginNextSession();
  EXPECT_FALSE(odometry.isAhead());
  EXPECT_EQ(odometry.start(), 50 * kPosePeriod);
  EXPECT_DOUBLE_EQ(odometry.travelled(54 * kPosePeriod), 4.0);
}

TEST(SessionOdometry, LeavesOutPosesOfTheSessionBeforeThatComeLate) {
  SessionOdometry odometry;
  drive(odometry, 100 * kPosePeriod, 11, 2.0);
  odometry.beginNextSession();
  drive(odometry, 111 * kPosePeriod, 2, 2.0);
  EXPECT_FALSE(odometry.start());
  drive(odometry, 100 * kPosePeriod, 5, 1.0);
  EXPECT_EQ(odometry.start(), 100 * kPosePeriod);
  EXPECT_DOUBLE_EQ(odometry.travelled(104 * kPosePeriod), 4.0);
  EXPECT_FALSE(odometry.isAhead());
}

}  // namespace
}  // namespace fabmap_node
