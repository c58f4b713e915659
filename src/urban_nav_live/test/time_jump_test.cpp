// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/time_jump.hpp"

#include <gtest/gtest.h>

namespace urban_nav_live {
namespace {

constexpr urban_nav_core::StampNs clock_start = 1'600'000'000'000'000'000;

TEST(TimeJumpDetector, ToleratesLateStamps) {
  TimeJumpDetector detector;
  EXPECT_FALSE(detector.add(clock_start));
  EXPECT_FALSE(detector.add(clock_start + 5 * max_step_back));
  EXPECT_FALSE(detector.add(clock_start + 4 * max_step_back));
  EXPECT_EQ(detector.newest(), clock_start + 5 * max_step_back);
}

TEST(TimeJumpDetector, DetectsAJumpOnceAndStartsAnew) {
  TimeJumpDetector detector;
  detector.add(clock_start);
  EXPECT_TRUE(detector.jumpsBack(clock_start - max_step_back - 1));
  EXPECT_TRUE(detector.add(clock_start - max_step_back - 1));
  EXPECT_EQ(detector.newest(), clock_start - max_step_back - 1);
  EXPECT_FALSE(detector.add(clock_start - max_step_back));
}

TEST(TimeJumpDetector, WithoutAStampNothingJumps) {
  TimeJumpDetector detector;
  EXPECT_FALSE(detector.jumpsBack(0));
  detector.advance(clock_start);
  detector.advance(clock_start - 1);
  EXPECT_EQ(detector.newest(), clock_start);
  detector.reset();
  EXPECT_FALSE(detector.add(0));
}

}  // namespace
}  // namespace urban_nav_live
