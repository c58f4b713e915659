// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/frame_gaps.hpp"

#include <gtest/gtest.h>

#include <random>

namespace urban_nav_live {
namespace {

constexpr urban_nav_core::StampNs kFramePeriod = 50'000'000;

TEST(FrameGaps, CountWhatALossyConnectionLeftOut) {
  for (const double loss : {0.0, 0.01, 0.1, 0.3}) {
    FrameGaps gaps;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0), jitter(-2e6, 2e6);
    int lost = 0;
    for (int i = 0; i < 2000; ++i) {
      const bool is_lost = i > 30 && i < 1999 && share(random) < loss;
      if (is_lost) ++lost;
      else gaps.add(i * kFramePeriod + static_cast<urban_nav_core::StampNs>(jitter(random)));
    }
    EXPECT_EQ(gaps.missing(), lost) << loss;
    EXPECT_EQ(gaps.frames(), 2000 - lost);
  }
}

TEST(FrameGaps, AJumpBackAndARestartAreNoGaps) {
  FrameGaps gaps;
  for (int i = 0; i < 20; ++i) gaps.add(i * kFramePeriod);
  for (int i = 0; i < 20; ++i) gaps.add(i * kFramePeriod);
  gaps.restart();
  for (int i = 1000; i < 1020; ++i) gaps.add(i * kFramePeriod);
  EXPECT_EQ(gaps.missing(), 0);
}

}  // namespace
}  // namespace urban_nav_live
