// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/reprojection_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "urban_nav_trust/trust_monitor.hpp"

namespace urban_nav_trust {
namespace {

constexpr urban_nav_core::StampNs kFramePeriod = 50'000'000;  // ns
constexpr int kFramesPerSecond = 20;

/// Frames of a drive whose scene changes the logarithm of the error by `scatter`, with the correlation one half from
/// second to second, and by 0.1 from frame to frame.
class DriveThroughScenes {
 public:
  DriveThroughScenes(unsigned seed, double scatter) : random_(seed), scatter_(scatter) {}
  bool pass(ReprojectionMonitor& monitor, int seconds, double error_px) {
    bool any = false;
    for (int s = 0; s < seconds; ++s) {
      scene_ = 0.5 * scene_ + std::sqrt(0.75) * scatter_ * normal_(random_);
      for (int i = 0; i < kFramesPerSecond; ++i) {
        urban_nav_core::FrameMeasurements frame;
        frame.stamp = ++frames_ * kFramePeriod;
        frame.reprojection_px = error_px * std::exp(scene_ + 0.1 * normal_(random_));
        any |= monitor.add(frame);
      }
    }
    return any;
  }
  urban_nav_core::StampNs now() const { return frames_ * kFramePeriod; }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  double scatter_, scene_ = 0.0;
  std::int64_t frames_ = 0;
};

TEST(ReprojectionMonitor, IsSilentOnSoundDrivesThroughCalmAndVariedScenes) {
  for (const double scatter : {0.02, 0.15, 0.3})
    for (unsigned seed = 1; seed <= 150; ++seed) {
      ReprojectionMonitor monitor({});
      EXPECT_FALSE(DriveThroughScenes(seed, scatter).pass(monitor, 120, 0.4)) << scatter << ", " << seed;
      const auto test = monitor.test();
      ASSERT_TRUE(test);
      EXPECT_GT(test->p_value, Parameters().false_alarm) << scatter << ", " << seed;
      EXPECT_FALSE(test->sentence.empty());
    }
}

// An hour of correlated scenes is the null distribution that the threshold is stated for.
TEST(ReprojectionMonitor, FalseAlarmsAreNotMoreFrequentThanStated) {
  Parameters loose;
  loose.false_alarm = 0.2;
  constexpr int kDrives = 40, kHour = 3600;
  int alarms = 0;
  for (unsigned seed = 1; seed <= kDrives; ++seed) {
    ReprojectionMonitor monitor(loose);
    alarms += DriveThroughScenes(seed, 0.25).pass(monitor, kHour, 2.0) ? 1 : 0;
  }
  EXPECT_LE(alarms, 13);  // 99 % of a binomial variable with 40 drives and probability 0.2
}

TEST(ReprojectionMonitor, NamesALastingRiseWithItsTimeAndSize) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    ReprojectionMonitor monitor({});
    DriveThroughScenes drive(seed, 0.12);
    drive.pass(monitor, 20, 0.35);
    const urban_nav_core::StampNs change = drive.now();
    EXPECT_TRUE(drive.pass(monitor, 15, 1.4)) << seed;
    const auto test = monitor.test();
    ASSERT_TRUE(test);
    EXPECT_LT(test->p_value, Parameters().false_alarm);
    EXPECT_LE(std::abs(test->interval.from - change), 2'000'000'000) << seed;
    EXPECT_NE(test->sentence.find("px"), std::string::npos);
    EXPECT_FALSE(test->remedy.empty());
  }
}

TEST(ReprojectionMonitor, AStartFromRestOrASingleBadSecondIsNoFault) {
  ReprojectionMonitor starts({}), blinded({});
  DriveThroughScenes resting(1, 0.1), drive(2, 0.1);
  resting.pass(starts, 10, 0.03);
  EXPECT_FALSE(resting.pass(starts, 60, 0.35));
  EXPECT_GT(starts.test()->p_value, Parameters().false_alarm);
  drive.pass(blinded, 20, 0.35);
  EXPECT_FALSE(drive.pass(blinded, 1, 3.0));
  EXPECT_FALSE(drive.pass(blinded, 60, 0.35));
  EXPECT_GT(blinded.test()->p_value, Parameters().false_alarm);
}

TEST(ReprojectionMonitor, AFallIsNoFault) {
  ReprojectionMonitor monitor({});
  DriveThroughScenes drive(3, 0.1);
  drive.pass(monitor, 20, 2.0);
  EXPECT_FALSE(drive.pass(monitor, 40, 0.2));
  EXPECT_GT(monitor.test()->p_value, Parameters().false_alarm);
}

TEST(ReprojectionMonitor, ValuesThatAreNotMeasuredAreIgnored) {
  ReprojectionMonitor monitor({});
  for (const double error :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (int i = 0; i < 100; ++i) {
      urban_nav_core::FrameMeasurements frame;
      frame.stamp = i * kFramePeriod;
      frame.reprojection_px = error;
      EXPECT_FALSE(monitor.add(frame));
    }
  EXPECT_FALSE(monitor.test());
}

TEST(ReprojectionMonitor, IsPartOfASessionAndConfirmsNothing) {
  TrustMonitor monitor({});
  urban_nav_core::FrameMeasurements frame;
  for (int i = 0; i < 100; ++i) {
    frame.stamp = i * kFramePeriod;
    frame.reprojection_px = 0.3;
    monitor.add(frame);
  }
  TestResults results = monitor.results();
  ASSERT_EQ(results.tests.size(), 1U);
  EXPECT_EQ(results.tests[0].name, kReprojectionTest);
  EXPECT_FALSE(confirm(results).any);
  for (const AbsentMeasurement& absent : TrustMonitor({}).results().absent)
    if (absent.name == kReprojectionTest) return;
  FAIL() << "not listed as absent without frames";
}

}  // namespace
}  // namespace urban_nav_trust
