// SPDX-License-Identifier: BSD-3-Clause
#include "live/rate_controller.hpp"

#include <gtest/gtest.h>

namespace urban_nav_sim {
namespace {

using std::chrono::milliseconds;
using urban_nav_core::StampNs;

constexpr StampNs kMs = 1'000'000;
constexpr StampNs kFirst = 1'225'719'873'000 * kMs;

RateController::Wall wall(int after_ms) { return RateController::Wall(milliseconds(1'000'000 + after_ms)); }

TEST(RateController, GoesAtTheRateThatIsAskedFor) {
  RateController pace(2.0);
  EXPECT_EQ(pace.due(kFirst, wall(0)), wall(0));
  EXPECT_EQ(pace.due(kFirst + 100 * kMs, wall(1)), wall(50));
  EXPECT_EQ(pace.due(kFirst + 1000 * kMs, wall(60)), wall(500));
}

TEST(RateController, AllIsDueAtOnceAtRateZero) {
  RateController pace(0.0);
  EXPECT_EQ(pace.due(kFirst, wall(0)), wall(0));
  EXPECT_EQ(pace.due(kFirst + 100'000 * kMs, wall(7)), wall(7));
}

TEST(RateController, CatchesUpAfterAShortDelayAndSkipsALongOne) {
  RateController pace(1.0);
  pace.due(kFirst, wall(0));
  EXPECT_EQ(pace.due(kFirst + 100 * kMs, wall(700)), wall(100)) << "late, and due since long";
  EXPECT_EQ(pace.due(kFirst + 900 * kMs, wall(720)), wall(900)) << "in time again";
  EXPECT_EQ(pace.due(kFirst + 1000 * kMs, wall(3000)), wall(3000)) << "too late to catch up";
  EXPECT_EQ(pace.due(kFirst + 1500 * kMs, wall(3001)), wall(3500)) << "time continues from there";
}

TEST(RateController, APauseIsNoDelay) {
  RateController pace(1.0);
  pace.due(kFirst, wall(0));
  pace.restart();
  EXPECT_EQ(pace.due(kFirst + 10 * kMs, wall(60'000)), wall(60'000));
  EXPECT_EQ(pace.due(kFirst + 20 * kMs, wall(60'001)), wall(60'010));
  EXPECT_FALSE(pace.isSlow());
}

/// `steps` of 50 ms of the session, each taking `takes` ms to render.
void run(RateController& pace, int steps, int takes) {
  int now = 0;
  for (int k = 0; k < steps; ++k) {
    now += takes;
    const StampNs taken = kFirst + 50 * k * kMs;
    const RateController::Wall due = pace.due(taken, wall(now));
    if (due > wall(now)) now = static_cast<int>(std::chrono::duration_cast<milliseconds>(due - wall(0)).count());
    pace.passed(taken, wall(now));
  }
}

TEST(RateController, ReportsItsFactorAndWhetherItIsSlow) {
  RateController quick(1.0), slow(1.0);
  EXPECT_FALSE(quick.factor()) << "nothing measured yet";
  run(quick, 200, 20);
  ASSERT_TRUE(quick.factor());
  EXPECT_NEAR(*quick.factor(), 1.0, 0.02);
  EXPECT_FALSE(quick.isSlow());
  run(slow, 200, 125);
  ASSERT_TRUE(slow.factor());
  EXPECT_NEAR(*slow.factor(), 0.4, 0.02);
  EXPECT_TRUE(slow.isSlow());
}

}  // namespace
}  // namespace urban_nav_sim
