// SPDX-License-Identifier: BSD-3-Clause
#include "motion/segway.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_sim {
namespace {

SegwayState driven(SegwayState state, const SegwayCommand& command, const SegwayDisturbance& disturbance, double time,
                   double dt = 0.005) {
  for (int i = 0; i < static_cast<int>(std::lround(time / dt)); ++i)
    state = stepSegway(state, command, disturbance, dt);
  return state;
}

TEST(Segway, StaysUprightWithoutACommand) {
  const SegwayState state = driven({}, {}, {}, 10.0);
  EXPECT_EQ(state.pitch, 0.0);
  EXPECT_EQ(state.speed, 0.0);
}

TEST(Segway, IsStableOnSlopesAsWell) {
  SegwayDisturbance disturbance;
  disturbance.slope = 0.12;
  const SegwayState start = standingSegway({3, 4}, 0.5, disturbance.slope), state = driven(start, {}, disturbance, 5.0);
  EXPECT_GT(start.pitch, 0.03);
  EXPECT_NEAR(state.speed, 0.0, 1e-3);
  EXPECT_LT((state.position - Eigen::Vector2d(3, 4)).norm(), 2e-3);
}

TEST(Segway, RecoversFromATilt) {
  SegwayState tilted;
  tilted.pitch = 0.1;
  EXPECT_GT(driven(tilted, {}, {}, 0.3).speed, 0.05);  // drives under itself
  const SegwayState later = driven(tilted, {}, {}, 10.0);
  EXPECT_NEAR(later.pitch, 0.0, 1e-3);
  EXPECT_NEAR(later.speed, 0.0, 2e-3);
}

TEST(Segway, ReachesTheWantedSpeedOnTheLevelAndUphill) {
  for (const double slope : {0.0, 0.1, -0.1}) {
    SegwayDisturbance disturbance;
    disturbance.slope = slope;
    const SegwayState state = driven({}, {1.2, 0.0}, disturbance, 15.0);
    EXPECT_NEAR(state.speed, 1.2, 0.01) << slope;
    EXPECT_NEAR(state.pitch, std::asin(0.24 / 0.6 * std::sin(slope)), 1e-3) << slope;
  }
}

TEST(Segway, RollsBackALittleBeforeItMovesForward) {
  double least = 0.0;
  SegwayState state;
  for (int i = 0; i < 200; ++i) {
    state = stepSegway(state, {1.0, 0.0}, {}, 0.005);
    least = std::min(least, state.position.x());
  }
  EXPECT_LT(least, -0.005);
  EXPECT_GT(least, -0.2);
  EXPECT_GT(state.pitch, 0.0);
}

TEST(Segway, TurnsOnTheSpot) {
  const SegwayState state = driven({}, {0.0, 1.0}, {}, 5.0);
  EXPECT_NEAR(state.turn, 1.0, 1e-3);
  EXPECT_NEAR(state.yaw, 5.0, 0.5);
  EXPECT_LT(state.position.norm(), 1e-9);
}

TEST(Segway, HardlyDependsOnTheStep) {
  const SegwayState coarse = driven({}, {1.2, 0.4}, {}, 6.0, 0.005), fine = driven({}, {1.2, 0.4}, {}, 6.0, 0.0005);
  EXPECT_LT((coarse.position - fine.position).norm(), 0.03);
  EXPECT_NEAR(coarse.yaw, fine.yaw, 0.01);
}

}  // namespace
}  // namespace urban_nav_sim
