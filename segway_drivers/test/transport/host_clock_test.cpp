// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/transport/host_clock.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace segway_drivers {
namespace {

constexpr TimeNs kSecond = 1'000'000'000;

TEST(HostClock, AStepOfFiveSecondsIsReportedOnceAndFollowedAtOnce) {
  for (const TimeNs step : {5 * kSecond, -5 * kSecond}) {
    TimeNs offset = 1000 * kSecond;
    HostClock clock([&] { return offset; });
    EXPECT_EQ(clock.follow(), 0);
    EXPECT_EQ(clock.toReal(kSecond), 1001 * kSecond);
    offset += step;
    EXPECT_EQ(clock.follow(), step);
    EXPECT_EQ(clock.toReal(kSecond), 1001 * kSecond + step);
    EXPECT_EQ(clock.follow(), 0);
  }
}

TEST(HostClock, ASlewIsFollowedWithoutAReport) {
  TimeNs offset = 0;
  HostClock clock([&] { return offset; });
  for (int i = 0; i < 1000; ++i) {
    offset += 10'000;  // 500 ppm at 50 Hz
    EXPECT_EQ(clock.follow(), 0) << i;
  }
  EXPECT_LT(std::llabs(clock.toReal(0) - offset), 200'000);
}

}  // namespace
}  // namespace segway_drivers
