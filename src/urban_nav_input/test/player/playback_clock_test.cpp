// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/player/playback_clock.hpp"

#include <gtest/gtest.h>

namespace urban_nav_input {
namespace {

using std::chrono::milliseconds;

const PlaybackClock::HostTime kHost(std::chrono::hours(10));
constexpr urban_nav_core::StampNs kMillisecond = 1'000'000, kBagBegin = 1'225'719'872'000'000'000;

TEST(PlaybackClock, RunsAtItsRate) {
  const PlaybackClock clock(kBagBegin, 3.0, kHost, false);
  EXPECT_EQ(clock.at(kHost), kBagBegin);
  EXPECT_EQ(clock.at(kHost + milliseconds(50)), kBagBegin + 150 * kMillisecond);
  EXPECT_EQ(clock.due(kBagBegin + 150 * kMillisecond), kHost + milliseconds(50));
}

TEST(PlaybackClock, DoesNotChangeInAPause) {
  PlaybackClock clock(kBagBegin, 2.0, kHost, false);
  clock.pause(true, kHost + milliseconds(100));
  EXPECT_TRUE(clock.isPaused());
  EXPECT_EQ(clock.at(kHost + milliseconds(900)), kBagBegin + 200 * kMillisecond);
  EXPECT_EQ(clock.due(kBagBegin), PlaybackClock::HostTime::max());
  clock.pause(true, kHost + milliseconds(900));
  clock.pause(false, kHost + milliseconds(1000));
  EXPECT_EQ(clock.at(kHost + milliseconds(1000)), kBagBegin + 200 * kMillisecond);
  EXPECT_EQ(clock.at(kHost + milliseconds(1010)), kBagBegin + 220 * kMillisecond);
  EXPECT_EQ(clock.due(kBagBegin + 220 * kMillisecond), kHost + milliseconds(1010));
}

TEST(PlaybackClock, MayBeginPaused) {
  PlaybackClock clock(kBagBegin, 1.0, kHost, true);
  EXPECT_EQ(clock.at(kHost + milliseconds(500)), kBagBegin);
  clock.pause(false, kHost + milliseconds(500));
  EXPECT_EQ(clock.due(kBagBegin + kMillisecond), kHost + milliseconds(501));
}

}  // namespace
}  // namespace urban_nav_input
