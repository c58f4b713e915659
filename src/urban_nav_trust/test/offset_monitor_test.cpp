// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/offset_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace urban_nav_trust {
namespace {

constexpr urban_nav_core::StampNs kFrame = 50'000'000;
constexpr double kSigma = 0.03;  // px

/// Steps of a session as measured by odometry: errors of consecutive frames are correlated by one half, and a
/// displacement is visible until the landmarks are renewed, ten frames later.
class Session {
 public:
  explicit Session(unsigned seed) : random_(seed) {}
  bool drive(OffsetMonitor& monitor, int frames, double knock_px = 0.0) {
    bool any = false;
    for (int i = 0; i < frames; ++i) {
      error_ = 0.5 * error_ + std::sqrt(0.75) * kSigma * normal_(random_);
      any |= monitor.add(++k_ * kFrame, 0.08 + error_ + std::max(0.0, 1.0 - 0.1 * i) * knock_px, kSigma);
    }
    return any;
  }
  urban_nav_core::StampNs now() const { return k_ * kFrame; }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  std::int64_t k_ = 0;
  double error_ = 0.0;
};

TEST(OffsetMonitor, IsSilentInThreeHundredSessionsWithoutAKnock) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    OffsetMonitor monitor({});
    EXPECT_FALSE(Session(seed).drive(monitor, 1200)) << seed;
    const auto test = monitor.test();
    ASSERT_TRUE(test);
    EXPECT_GT(test->p_value, Parameters().false_alarm) << seed;
    EXPECT_EQ(monitor.segments().size(), 1U);
  }
}

TEST(OffsetMonitor, NamesAKnockWithItsTimeAndSizeWithinASecond) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    OffsetMonitor monitor({});
    Session session(seed);
    session.drive(monitor, 400);
    const urban_nav_core::StampNs knock = session.now();
    EXPECT_TRUE(session.drive(monitor, 20, -1.36)) << seed;
    session.drive(monitor, 400);
    const auto test = monitor.test();
    ASSERT_TRUE(test);
    EXPECT_LT(test->p_value, Parameters().false_alarm);
    EXPECT_LE(std::abs(test->interval.from - knock), kFrame) << seed;
    const auto segments = monitor.segments();
    ASSERT_EQ(segments.size(), 2U) << seed;
    EXPECT_NEAR(segments[1].value, -1.36, 0.15) << seed;
    EXPECT_NEAR(segments[1].value, -1.36, 5.0 * segments[1].sigma) << seed;
    EXPECT_EQ(segments[1].interval.from, test->interval.from);
    EXPECT_NE(test->sentence.find("px"), std::string::npos);
    EXPECT_FALSE(test->remedy.empty());
  }
}

TEST(OffsetMonitor, SeesASecondKnock) {
  OffsetMonitor monitor({});
  Session session(3);
  session.drive(monitor, 200);
  session.drive(monitor, 200, 0.8);
  session.drive(monitor, 200, -0.8);
  const auto segments = monitor.segments();
  ASSERT_EQ(segments.size(), 3U);
  EXPECT_NEAR(segments[2].value, 0.0, 0.2);
}

TEST(OffsetMonitor, IgnoresFramesWithoutMeasurement) {
  OffsetMonitor monitor({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  monitor.add(1, nan, 0.1);
  monitor.add(2, 0.1, nan);
  monitor.add(3, 0.1, 0.0);
  EXPECT_FALSE(monitor.test());
  EXPECT_TRUE(monitor.segments().empty());
  monitor.add(4, 0.1, 0.1);
  EXPECT_FALSE(monitor.test()) << "a single frame is not compared";
}

}  // namespace
}  // namespace urban_nav_trust
