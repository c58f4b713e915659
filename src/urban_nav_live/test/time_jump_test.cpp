// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/time_jump.hpp"

#include <gtest/gtest.h>

namespace urban_nav_live {
namespace {

constexpr urban_nav_core::StampNs kClockStart = 1'600'000'000'000'000'000;

TEST(TimeJumpDetector, ToleratesLateStamps) {
  TimeJumpDetector detector;
  EXPECT_FALSE(detector.add(kClockStart));
  EXPECT_FALSE(detector.add(kClockStart + 5 * kMaxStepBack));
  EXPECT_FALSE(detector.add(kClockStart + 4 * kMaxStepBack));
  EXPECT_EQ(detector.newest(), kClockStart + 5 * kMaxStepBack);
}

TEST(TimeJumpDetector, DetectsAJumpOnceAndRestarts) {
  TimeJumpDetector detector;
  detector.add(kClockStart);
  EXPECT_TRUE(detector.jumpsBack(kClockStart - kMaxStepBack - 1));
  EXPECT_TRUE(detector.add(kClockStart - kMaxStepBack - 1));
  EXPECT_EQ(detector.newest(), kClockStart - kMaxStepBack - 1);
  EXPECT_FALSE(detector.add(kClockStart - kMaxStepBack));
}

TEST(TimeJumpDetector, WithoutAStampNothingJumps) {
  TimeJumpDetector detector;
  EXPECT_FALSE(detector.jumpsBack(0));
  detector.advance(kClockStart);
  detector.advance(kClockStart - 1);
  EXPECT_EQ(detector.newest(), kClockStart);
  detector.reset();
  EXPECT_FALSE(detector.add(0));
}

}  // namespace
}  // namespace urban_nav_live
