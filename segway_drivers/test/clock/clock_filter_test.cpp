// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/clock/clock_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "segway_drivers/clock/counter_unwrapper.hpp"

namespace segway_drivers {
namespace {

constexpr double kClockSkew = 100e-6;
constexpr TimeNs kClockBegin = 1'000'000'000'000'000'000;

/// Outcome of one simulated recording with a least delay of 1 ms.
struct ClockTrial {
  double worst_early = 0.0, worst = 0.0;  // s, from 2 s on and after `settled`
  int epochs = 0, judged = 0, within = 0;
  bool rises = true;
};

ClockTrial runClock(double period, double duration, double settled,
                    const std::function<double(double, std::mt19937&)>& delay, unsigned seed) {
  ClockOptions options;
  options.period = period;
  ClockFilter filter(options);
  std::mt19937 random(seed);
  ClockTrial trial;
  TimeNs last_arrival = 0, last_stamp = 0;
  int last_epoch = 0;
  for (int i = 0; i * period < duration; ++i) {
    const double t = i * period;
    const TimeNs arrival =
        std::max(last_arrival, kClockBegin + static_cast<TimeNs>(std::llround(1e9 * (t + delay(t, random)))));
    last_arrival = arrival;
    const ClockEstimate estimate = filter.add(t * (1.0 + kClockSkew), arrival);
    EXPECT_EQ(estimate.time.has_value(), t * (1.0 + kClockSkew) >= 0.5) << t;
    if (!estimate.time) continue;
    trial.rises = trial.rises && (*estimate.time > last_stamp || estimate.epoch != last_epoch);
    last_stamp = *estimate.time;
    last_epoch = estimate.epoch;
    const double error = std::abs(1e-9 * static_cast<double>(*estimate.time - kClockBegin) - t - 1e-3);
    if (t > 2.0) trial.worst_early = std::max(trial.worst_early, error);
    if (t > settled) trial.worst = std::max(trial.worst, error);
    if (t > 2.0) ++trial.judged;
    if (t > 2.0 && error < 4.0 * estimate.sigma + 1e-4) ++trial.within;
  }
  trial.epochs = filter.epoch();
  return trial;
}

double longTail(double, std::mt19937& random) {
  return 1e-3 + std::min(std::exponential_distribution<double>(1.0 / 3e-3)(random), 19e-3);
}

double evenDelay(double, std::mt19937& random) { return std::uniform_real_distribution<double>(1e-3, 20e-3)(random); }

TEST(ClockFilter, DelaysWithALongTail) {
  for (const double period : {0.0133381, 0.01, 0.05}) {
    const ClockTrial trial = runClock(period, 120.0, 60.0, longTail, 1);
    EXPECT_LT(trial.worst_early, 1e-3) << period;
    EXPECT_LT(trial.worst, 0.3e-3) << period;
    EXPECT_GT(trial.within, 0.95 * trial.judged) << period;
    EXPECT_TRUE(trial.rises);
  }
}

TEST(ClockFilter, UniformDelaysOfUpTo20Milliseconds) {
  for (const double period : {0.0133381, 0.01, 0.05}) {
    const ClockTrial trial = runClock(period, 120.0, 60.0, evenDelay, 2);
    EXPECT_LT(trial.worst_early, 2.5e-3) << period;
    EXPECT_LT(trial.worst, 0.5e-3) << period;
    EXPECT_GT(trial.within, 0.95 * trial.judged) << period;
    EXPECT_TRUE(trial.rises);
  }
}

TEST(ClockFilter, ALeastDelayThatRisesForAMinuteDoesNotTiltTheLine) {
  const auto delay = [](double t, std::mt19937& random) {
    return longTail(t, random) + (t > 100.0 && t < 160.0 ? 5e-3 : 0.0);
  };
  for (const double period : {0.0133381, 0.05}) {
    const ClockTrial trial = runClock(period, 240.0, 60.0, delay, 3);
    EXPECT_LT(trial.worst, 0.3e-3) << period;
    EXPECT_GT(trial.within, 0.95 * trial.judged) << period;
  }
}

/// A raised stretch that is as long as what is known of the floor, with delays as wide as the rise.
TEST(ClockFilter, ARiseSoonAfterTheStartDoesNotTiltTheLine) {
  const auto delay = [](double t, std::mt19937& random) {
    return evenDelay(t, random) + (t > 65.0 && t < 125.0 ? 5e-3 : 0.0);
  };
  for (const double period : {0.0133381, 0.05})
    for (const unsigned seed : {5U, 15U, 19U}) {
      const ClockTrial trial = runClock(period, 180.0, 60.0, delay, seed);
      EXPECT_LT(trial.worst, 0.5e-3) << period << ", seed " << seed;
      EXPECT_GT(trial.within, 0.95 * trial.judged) << period << ", seed " << seed;
      EXPECT_EQ(trial.epochs, 0) << period << ", seed " << seed;
    }
}

/// An adapter that hands over bytes every 16 ms: a period that beats against it meets the least delay again and again.
TEST(ClockFilter, BatchesOfAnAdapter) {
  const auto delay = [](double t, std::mt19937&) { return 0.016 * std::ceil((t + 1e-3) / 0.016) - t; };
  const ClockTrial trial = runClock(0.0133381, 60.0, 20.0, delay, 7);
  EXPECT_LT(trial.worst_early, 1e-3);
  EXPECT_LT(trial.worst, 0.3e-3);
  EXPECT_TRUE(trial.rises);
}

TEST(ClockFilter, AStallWithABacklogDoesNotTiltAYoungLine) {
  const auto delay = [](double t, std::mt19937& random) {
    return longTail(t, random) + (t > 10.0 && t < 12.0 ? 12.0 - t : 0.0);
  };
  for (const double period : {0.0133381, 0.01}) {
    const ClockTrial trial = runClock(period, 60.0, 2.0, delay, 6);
    EXPECT_LT(trial.worst, 1e-3) << period;
    EXPECT_EQ(trial.epochs, 0) << period;
  }
}

/// One device time that is 5 s wrong begins an epoch; the line before it returns with the next measurement.
TEST(ClockFilter, AWrongDeviceTimeCostsItselfAlone) {
  for (const double wrong : {5.0, -5.0, 1000.0}) {
    ClockFilter filter(ClockOptions{});
    for (int i = 0; i < 3000; ++i) {
      const double t = 0.01 * i, device = t + (i == 2000 ? wrong : 0.0);
      const ClockEstimate estimate = filter.add(device, kClockBegin + static_cast<TimeNs>(std::llround(1e9 * t)));
      if (i == 2000 || i < 100) continue;
      ASSERT_TRUE(estimate.time.has_value()) << wrong << " " << i;
      EXPECT_NEAR(1e-9 * static_cast<double>(*estimate.time - kClockBegin), t, 1e-5);
      EXPECT_EQ(estimate.epoch, i < 2000 ? 0 : 2);
    }
  }
}

TEST(ClockFilter, CongestionAtTheStartEndsInANewEpoch) {
  const auto delay = [](double t, std::mt19937& random) { return longTail(t, random) + (t < 40.0 ? 5e-3 : 0.0); };
  const ClockTrial trial = runClock(0.01, 120.0, 45.0, delay, 4);
  EXPECT_EQ(trial.epochs, 1);
  EXPECT_LT(trial.worst, 0.6e-3);
  EXPECT_TRUE(trial.rises);
}

/// Constant delays: every estimate after a jump of host or device clock is exact or belongs to a new epoch.
TEST(ClockFilter, StepsOfEitherClockAreDeclared) {
  for (const double host_step : {5.0, -5.0, 0.0}) {
    ClockFilter filter(ClockOptions{});
    int wrong = 0;
    for (int i = 0; i < 3000; ++i) {
      const double t = 0.01 * i;
      const bool after = i >= 1000;
      const double host = t + (after ? host_step : 0.0), device = after && host_step == 0.0 ? t - 9.0 : t;
      const ClockEstimate estimate = filter.add(device, kClockBegin + static_cast<TimeNs>(std::llround(1e9 * host)));
      if (!estimate.time || (after && estimate.epoch == 0)) continue;
      if (std::abs(1e-9 * static_cast<double>(*estimate.time - kClockBegin) - host) > 1e-4) ++wrong;
    }
    EXPECT_EQ(filter.epoch(), 1) << host_step;
    EXPECT_EQ(wrong, 0) << host_step;
  }
}

TEST(ClockFilter, ABacklogIsNoStep) {
  ClockFilter filter(ClockOptions{});
  for (int i = 0; i < 3000; ++i) {
    const double t = 0.01 * i, host = t > 15.0 && t < 18.0 ? 18.0 : t;
    const ClockEstimate estimate = filter.add(t, kClockBegin + static_cast<TimeNs>(std::llround(1e9 * host)));
    if (estimate.time) {
      EXPECT_NEAR(1e-9 * static_cast<double>(*estimate.time - kClockBegin), t, 1e-5);
    }
  }
  EXPECT_EQ(filter.epoch(), 0);
}

TEST(CounterUnwrapper, GapsOfAnySizeAreResolvedByArrivalTimes) {
  for (const int gap : {1, 2, 127, 255, 256, 257, 700}) {
    CounterUnwrapper counter(256, 0.013338);
    std::int64_t sent = 0;
    for (int i = 0; i < 300; ++i) {
      sent += i == 150 ? gap : 1;
      const UnwrappedCount count =
          counter.add(static_cast<std::uint32_t>(sent % 256), 1 + static_cast<TimeNs>(13'338'000) * sent);
      EXPECT_EQ(count.count, sent - 1) << gap;
      EXPECT_EQ(count.missing, i == 150 ? gap - 1 : 0) << gap;
      EXPECT_FALSE(count.restarted);
    }
  }
}

TEST(CounterUnwrapper, ACounterThatBeginsAgainIsARestart) {
  CounterUnwrapper counter(65536, 0.01);
  for (std::uint32_t i = 0; i < 100; ++i) counter.add(30000 + i, 1 + static_cast<TimeNs>(i) * 10'000'000);
  EXPECT_TRUE(counter.add(0, 1'050'000'000).restarted);
  EXPECT_FALSE(counter.add(1, 1'060'000'000).restarted);
}

TEST(CounterUnwrapper, ARepeatedValueIsNoMeasurement) {
  CounterUnwrapper counter(256, 0.013338);
  counter.add(5, 1'000'000'000);
  const UnwrappedCount count = counter.add(5, 1'001'000'000);
  EXPECT_TRUE(count.repeated);
  EXPECT_EQ(count.count, 0);
}

}  // namespace
}  // namespace segway_drivers
