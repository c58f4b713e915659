// SPDX-License-Identifier: BSD-3-Clause
#include "live/frame_pacer.hpp"

#include <gtest/gtest.h>

namespace segway_drivers {
namespace {

constexpr TimeNs kPeriod = 50'000'000;  // ns

TEST(FramePacer, WaitsForTheOdometryAndGoesOnWhenItHasTakenAFrame) {
  FramePacer pacer;
  TimeNs stamp = 0;
  for (std::size_t i = 0; i < FramePacer::kAhead; ++i) {
    ASSERT_TRUE(pacer.isFree(0)) << i;
    pacer.sent(stamp += kPeriod, 0);
  }
  EXPECT_FALSE(pacer.isFree(FramePacer::kPatience - 1));
  pacer.answered(kPeriod - 1);
  EXPECT_FALSE(pacer.isFree(0)) << "that was none of them";
  pacer.answered(kPeriod);
  EXPECT_TRUE(pacer.isFree(0));
  pacer.sent(stamp += kPeriod, 0);
  EXPECT_FALSE(pacer.isFree(0));
  pacer.answered(stamp);
  EXPECT_TRUE(pacer.isFree(0)) << "an answer holds for all before it";
}

TEST(FramePacer, GoesOnWithoutAnAnswerAfterItsPatience) {
  FramePacer pacer;
  TimeNs now = 0;
  for (std::size_t i = 0; i < 3 * FramePacer::kAhead; ++i) {
    if (!pacer.isFree(now)) now += FramePacer::kPatience;
    ASSERT_TRUE(pacer.isFree(now)) << i;
    pacer.sent(static_cast<TimeNs>(i) * kPeriod, now);
  }
  EXPECT_EQ(now, 2 * static_cast<TimeNs>(FramePacer::kAhead) * FramePacer::kPatience);
}

}  // namespace
}  // namespace segway_drivers
