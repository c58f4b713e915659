// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/change_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "urban_nav_core/trajectory/chi_square.hpp"

namespace urban_nav_core {
namespace {

constexpr StampNs kDetectorSecond = 1'000'000'000;

/// Measurements of a constant, with different standard deviations.
class Drive {
 public:
  explicit Drive(unsigned seed) : random_(seed) {}
  ConstantMeasurement measure(double value) {
    ConstantMeasurement result;
    result.interval = {k_ * kDetectorSecond, (k_ + 1) * kDetectorSecond};
    result.sigma = 0.05 * (1.0 + static_cast<double>(k_ % 3));
    result.value = value + result.sigma * normal_(random_);
    ++k_;
    return result;
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  std::int64_t k_ = 0;
};

/// Returns the share of 2000 sequences of a constant with an alarm, at the detector's own threshold.
int countAlarms(double false_alarm, std::int64_t length) {
  int alarms = 0;
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    Drive drive(seed);
    ChangeDetector detector(false_alarm, length);
    bool any = false;
    for (std::int64_t k = 0; k < length; ++k) any |= detector.add(drive.measure(-3.0));
    alarms += any ? 1 : 0;
  }
  return alarms;
}

TEST(ChangeDetector, RaisesFalseAlarmsAsOftenAsStated) {
  // Siegmund's approximation is accurate to a few percent, also with recursive residuals and different sigmas.
  for (const double stated : {0.02, 0.1, 0.3}) {
    const double expected = 2000.0 * stated, band = 4.0 * std::sqrt(expected * (1.0 - stated)) + 0.15 * expected;
    EXPECT_NEAR(countAlarms(stated, 60), expected, band) << stated;
    EXPECT_NEAR(countAlarms(stated, 400), expected, band) << stated;
  }
}

TEST(ChangeDetector, FindsASmallChangeWithinTheStatedDelay) {
  // A change of 2 sigma minus the reference of 1/2 takes (threshold + 1.166) / 1.5 measurements on average, if the
  // constant was known exactly before (Wald's identity).
  double delay = 0.0, squares = 0.0;
  const int runs = 300;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    ChangeDetector detector(1e-6, 1000);
    std::int64_t k = 0;
    const auto add = [&](double value) {
      ConstantMeasurement result{{k * kDetectorSecond, (k + 1) * kDetectorSecond}, value + normal(random), 1.0};
      ++k;
      return detector.add(result);
    };
    for (int i = 0; i < 400; ++i) ASSERT_FALSE(add(0.0));
    int needed = 1;
    while (!add(2.0)) ++needed;
    delay += needed;
    const std::vector<ChangeDetector::Segment> segments = detector.segments();
    ASSERT_EQ(segments.size(), 2U);
    const double error = static_cast<double>(segments[1].interval.from / kDetectorSecond) - 400.0;
    squares += error * error;
    EXPECT_EQ(segments[0].interval.to, segments[1].interval.from);
  }
  const double expected = (ChangeDetector(1e-6, 1000).threshold() + 1.166) / 1.5;
  EXPECT_NEAR(delay / runs, expected, 0.08 * expected);
  EXPECT_LT(std::sqrt(squares / runs), 4.0);  // measurements between the change and its estimate
}

TEST(ChangeDetector, EstimatesTheConstantBeforeAndAfter) {
  ChangeDetector detector(1e-4, 100);
  Drive drive(7);
  for (int k = 0; k < 30; ++k) detector.add(drive.measure(0.2));
  for (int k = 0; k < 30; ++k) detector.add(drive.measure(-1.2));
  const std::vector<ChangeDetector::Segment> segments = detector.segments();
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[1].interval.from, 30 * kDetectorSecond);
  EXPECT_EQ(detector.measurements(), 60);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(segments[i].measurements, 30);
    EXPECT_NEAR(segments[i].mean, i == 0 ? 0.2 : -1.2, 4.0 * segments[i].sigma);
    // Ten each of 0.05, 0.1 and 0.15.
    EXPECT_NEAR(segments[i].sigma, 1.0 / std::sqrt(10.0 / 0.0025 + 10.0 / 0.01 + 10.0 / 0.0225), 1e-12);
  }
}

TEST(ChangeDetector, OfALongSegmentTheMeanIsThatOfAll) {
  ChangeDetector detector(1e-6, 10000);
  Drive drive(5);
  double weight = 0.0, weighted = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const ConstantMeasurement measurement = drive.measure(0.3);
    weight += 1.0 / (measurement.sigma * measurement.sigma);
    weighted += measurement.value / (measurement.sigma * measurement.sigma);
    ASSERT_FALSE(detector.add(measurement));
  }
  for (int k = 0; k < 40; ++k) detector.add(drive.measure(1.3));
  const std::vector<ChangeDetector::Segment> segments = detector.segments();
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].measurements, 3000);
  EXPECT_EQ(segments[0].interval.from, 0);
  EXPECT_NEAR(segments[0].mean, weighted / weight, 1e-12);
}

TEST(ChangeDetector, IgnoresWhatIsNoMeasurement) {
  ChangeDetector detector(1e-4, 100);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [value, sigma] : std::vector<std::pair<double, double>>{
           {nan, 1.0}, {0.0, nan}, {0.0, 0.0}, {0.0, -1.0}, {0.0, std::numeric_limits<double>::infinity()}})
    EXPECT_FALSE(detector.add({{0, kDetectorSecond}, value, sigma}));
  EXPECT_EQ(detector.measurements(), 0);
  EXPECT_TRUE(detector.segments().empty());
  EXPECT_FALSE(detector.add({{0, kDetectorSecond}, 1e6, 1e-6}));  // the first one defines the constant
  EXPECT_EQ(detector.segments().front().mean, 1e6);
}

TEST(ChangeDetector, ContinuesFromItsState) {
  ChangeDetector whole(1e-4, 100, 8);
  Drive drive(11);
  for (int k = 0; k < 30; ++k) whole.add(drive.measure(0.2));
  Archive writing;
  writing(whole);
  const std::string bytes = writing.take();
  ChangeDetector resumed(1e-4, 100, 8);
  Archive reading(bytes, "state");
  reading(resumed);
  reading.finish();
  for (int k = 0; k < 30; ++k) {
    const ConstantMeasurement measurement = drive.measure(-1.2);
    EXPECT_EQ(resumed.add(measurement), whole.add(measurement));
  }
  ASSERT_EQ(whole.segments().size(), 2U);
  EXPECT_EQ(resumed.segments()[1].mean, whole.segments()[1].mean);
  EXPECT_EQ(resumed.segments()[1].interval.from, whole.segments()[1].interval.from);
}

TEST(ChangeProbability, IsOneForNothingAndFallsByE) {
  EXPECT_NEAR(changeProbability(0.0, 1'000'000), 1.0, 1e-9);
  EXPECT_NEAR(changeProbability(21.0, 100) / changeProbability(20.0, 100), std::exp(-1.0), 1e-3);
  EXPECT_NEAR(changeProbability(20.0, 200) / changeProbability(20.0, 100), 2.0, 1e-3);
}

}  // namespace
}  // namespace urban_nav_core
