// SPDX-License-Identifier: BSD-3-Clause
#include "session/timeline.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_sim {
namespace {

Measurement stamped(urban_nav_core::StampNs stamp) {
  ImuMeasurement imu;
  imu.stamp = stamp;
  return imu;
}

TEST(Timeline, QueriesDevicesInTheOrderOfTime) {
  Timeline timeline(1.0);
  const auto sayingTime = [](const Schedule& schedule, int copies) {
    return [schedule, copies](std::int64_t k) {
      return std::vector<Measurement>(static_cast<std::size_t>(copies), stamped(std::llround(1e9 * schedule.at(k))));
    };
  };
  const Schedule fast{0.1, 0.03}, slow{0.4, 0.0};
  timeline.add(fast, sayingTime(fast, 1));
  timeline.add(slow, sayingTime(slow, 2));
  timeline.add({0.25, 0.0}, [](std::int64_t) { return std::vector<Measurement>(); });
  double last = 0.0;
  int count = 0;
  while (const auto due = timeline.next()) {
    EXPECT_GE(due->taken, last);
    EXPECT_EQ(toStamp(due->measurement), std::llround(1e9 * due->taken));
    last = due->taken;
    ++count;
  }
  EXPECT_EQ(count, 10 + 2 * 3);
  EXPECT_FALSE(timeline.next());
}

}  // namespace
}  // namespace urban_nav_sim
