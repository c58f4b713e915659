// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/time_jump.hpp"

#include <gtest/gtest.h>

namespace urban_nav_live {
namespace {

constexpr urban_nav_core::StampNs start = 1'600'000'000'000'000'000;

TEST(TimeJumpDetector, ToleratesLateStamps) {
  TimeJumpDetector detector;
  EXPECT_FALSE(detector.add(start));
  EXPECT_FALSE(detector.add(start + 5 * max_step_back));
  EXPECT_FALSE(detector.add(start + 4 * max_step_back));
  EXPECT_EQ(detector.newest(), start + 5 * max_step_back);
}

TEST(TimeJumpDetector, DetectsAJumpOnceAndStartsAnew) {
  TimeJumpDetector detector;
  detector.add(start);
  EXPECT_TRUE(detector.jumpsBack(start - max_step_back - 1));
  EXPECT_TRUE(detector.add(start - max_step_back - 1));
  EXPECT_EQ(detector.newest(), start - max_step_back - 1);
  EXPECT_FALSE(detector.add(start - max_step_back));
}

TEST(TimeJumpDetector, WithoutAStampNothingJumps) {
  TimeJumpDetector detector;
  EXPECT_FALSE(detector.jumpsBack(0));
  detector.advance(start);
  detector.advance(start - 1);
  EXPECT_EQ(detector.newest(), start);
  detector.reset();
  EXPECT_FALSE(detector.add(0));
}

}  // namespace
}  // namespace urban_nav_live
