// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/clock.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "proprioception/schedule.hpp"

namespace urban_nav_sim {
namespace {

constexpr urban_nav_core::StampNs kClockBegin = 1225719873501685000;

TEST(Clock, WithoutErrorsStampsAreTrue) {
  const Clock clock(kClockBegin, ClockOptions{}, Noise(1, "clock"));
  EXPECT_EQ(clock.stamp(3, 0.0), kClockBegin);
  EXPECT_EQ(clock.stamp(3, 3600.000000001), kClockBegin + 3600000000001);
  EXPECT_EQ(clock.taken(0.05), kClockBegin + 50000000);
}

TEST(Clock, HasOffsetSkewAndJitter) {
  ClockOptions options;
  options.offset = 0.25;
  options.skew = 1e-4;
  options.jitter = 1e-3;
  const Clock clock(kClockBegin, options, Noise(1, "clock"));
  double mean = 0.0, square = 0.0;
  constexpr int kMany = 20000;
  for (int k = 0; k < kMany; ++k) {
    const double t = 0.01 * k;
    const double jitter = 1e-9 * static_cast<double>(clock.stamp(k, t) - clock.taken(t)) - 0.25 - 1e-4 * t;
    EXPECT_LT(std::abs(jitter), 3.001e-3);
    mean += jitter / kMany;
    square += jitter * jitter / kMany;
  }
  EXPECT_NEAR(mean, 0.0, 5e-5);
  EXPECT_NEAR(std::sqrt(square), 1e-3, 5e-5);
}

TEST(Clock, StampsOfEverySensorIncrease) {
  for (const Sensor sensor : kAllSensors) {
    for (const ClockOptions& options : {correctedClock(sensor), uncorrectedClock(sensor, 7)}) {
      const Clock clock(kClockBegin, options, Noise(3, toString(sensor)));
      const Schedule schedule = sensorSchedule(sensor);
      for (std::int64_t k = 1; k < 20000; ++k) {
        ASSERT_GT(clock.stamp(k, schedule.at(k)), clock.stamp(k - 1, schedule.at(k - 1))) << toString(sensor);
      }
    }
  }
}

TEST(Clock, UncorrectedOnesAreWrongByMilliseconds) {
  const ClockOptions a = uncorrectedClock(Sensor::Imu, 1), b = uncorrectedClock(Sensor::Stereo, 1);
  EXPECT_NE(a.offset, b.offset);
  EXPECT_LE(std::abs(a.offset), 0.5);
  EXPECT_LE(std::abs(a.skew), 30e-6);
  EXPECT_EQ(uncorrectedClock(Sensor::Imu, 1).offset, a.offset);
}

TEST(Schedule, CountsWhatFitsBeforeTheEnd) {
  EXPECT_EQ((Schedule{0.05, 0.0}.count(24.0)), 480);
  EXPECT_EQ((Schedule{0.05, 0.012}.count(24.0)), 480);
  EXPECT_EQ((Schedule{0.5, 0.137}.count(0.1)), 0);
  EXPECT_EQ((Schedule{0.5, 0.137}.count(0.2)), 1);
  EXPECT_EQ(truthSchedule().count(24.0), 4800);
  EXPECT_EQ(sensorSchedule(Sensor::Wheels).count(24.0), 667);
}

TEST(Schedule, LasersTurnAsInTheLog) {
  EXPECT_NEAR(1.0 / laserSchedule(Side::Left).period, 74.973, 0.001);
  EXPECT_NEAR(laserSchedule(Side::Right).at(5) - laserSchedule(Side::Left).at(5), 5.54e-3, 1e-12);
}

}  // namespace
}  // namespace urban_nav_sim
