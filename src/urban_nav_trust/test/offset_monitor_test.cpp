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

urban_nav_core::FrameMeasurements frameAt(urban_nav_core::StampNs stamp, double step_px, double sigma_px,
                                          const Eigen::Vector3d& right_turn = Eigen::Vector3d::Zero()) {
  urban_nav_core::FrameMeasurements frame;
  frame.stamp = stamp;
  frame.disparity_step_px = step_px;
  frame.disparity_step_sigma_px = sigma_px;
  frame.right_turn = right_turn;
  return frame;
}

/// Steps of a session as measured by odometry: errors of consecutive frames are correlated by one half, and a
/// displacement is visible until the landmarks are renewed, ten frames later.
class Session {
 public:
  explicit Session(unsigned seed) : random_(seed) {}
  bool drive(OffsetMonitor& monitor, int frames, double knock_px = 0.0) {
    bool any = false;
    for (int i = 0; i < frames; ++i) {
      error_ = 0.5 * error_ + std::sqrt(0.75) * kSigma * normal_(random_);
      any |= monitor.add(frameAt(++k_ * kFrame, 0.08 + error_ + std::max(0.0, 1.0 - 0.1 * i) * knock_px, kSigma, turn));
    }
    return any;
  }
  urban_nav_core::StampNs now() const { return k_ * kFrame; }
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< corrected by odometry

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

TEST(OffsetMonitor, DetectsASecondKnock) {
  OffsetMonitor monitor({});
  Session session(3);
  session.drive(monitor, 200);
  session.drive(monitor, 200, 0.8);
  session.drive(monitor, 200, -0.8);
  const auto segments = monitor.segments();
  ASSERT_EQ(segments.size(), 3U);
  EXPECT_NEAR(segments[2].value, 0.0, 0.2);
}

TEST(OffsetMonitor, AKnockThatOdometryCorrectsAtOnceIsNamedAndEndsInItsFrame) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    OffsetMonitor monitor({});
    Session session(seed);
    session.drive(monitor, 400);
    const urban_nav_core::StampNs knock = session.now();
    session.turn = Eigen::Vector3d(0.0, -0.0035, 0.0);
    EXPECT_TRUE(session.drive(monitor, 1, -1.36)) << seed;
    session.drive(monitor, 19, -1.36);
    session.drive(monitor, 1200);
    const auto test = monitor.test();
    ASSERT_TRUE(test);
    EXPECT_LT(test->p_value, Parameters().false_alarm);
    EXPECT_TRUE(test->is_corrected);
    EXPECT_EQ(test->interval.from, knock);
    EXPECT_EQ(test->interval.to, knock + kFrame);
    EXPECT_NE(test->sentence.find("yaw"), std::string::npos) << test->sentence;
    const auto segments = monitor.segments();
    ASSERT_EQ(segments.size(), 2U) << seed;
    EXPECT_NEAR(segments[1].value, -1.36, 5.0 * segments[1].sigma) << seed;
  }
}

// A roll displaces rows, of which disparities show nothing.
TEST(OffsetMonitor, ATurnWithoutADisparityStepIsNamedToo) {
  OffsetMonitor monitor({});
  Session session(5);
  session.drive(monitor, 200);
  session.turn = Eigen::Vector3d(0.0, 0.0, 0.003);
  EXPECT_TRUE(session.drive(monitor, 200));
  const auto test = monitor.test();
  ASSERT_TRUE(test);
  EXPECT_LT(test->p_value, Parameters().false_alarm);
  EXPECT_TRUE(test->is_corrected);
}

TEST(OffsetMonitor, ACorrectionThatComesAfterTheAlarmEndsTheIntervalThere) {
  OffsetMonitor monitor({});
  Session session(6);
  session.drive(monitor, 200);
  const urban_nav_core::StampNs knock = session.now();
  session.drive(monitor, 8, -1.36);
  EXPECT_FALSE(monitor.test()->is_corrected);
  session.turn = Eigen::Vector3d(0.0, -0.0035, 0.0);
  session.drive(monitor, 100);
  const auto test = monitor.test();
  EXPECT_TRUE(test->is_corrected);
  EXPECT_LE(std::abs(test->interval.from - knock), kFrame);
  EXPECT_EQ(test->interval.to, knock + 9 * kFrame);
  EXPECT_EQ(monitor.segments().size(), 2U) << "one change";
}

TEST(OffsetMonitor, OneChangeWithoutACorrectionLeavesTheTestOpen) {
  OffsetMonitor monitor({});
  Session session(7);
  session.drive(monitor, 200);
  session.turn = Eigen::Vector3d(0.0, -0.0035, 0.0);
  session.drive(monitor, 200, -1.36);
  EXPECT_TRUE(monitor.test()->is_corrected);
  const urban_nav_core::StampNs second = session.now();
  session.drive(monitor, 200, 1.0);
  const auto test = monitor.test();
  EXPECT_FALSE(test->is_corrected);
  EXPECT_LE(std::abs(test->interval.from - second), kFrame);
  EXPECT_EQ(test->interval.to, session.now());
}

TEST(OffsetMonitor, IgnoresFramesWithoutMeasurement) {
  OffsetMonitor monitor({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  monitor.add(frameAt(1, nan, 0.1));
  monitor.add(frameAt(2, 0.1, nan));
  monitor.add(frameAt(3, 0.1, 0.0));
  EXPECT_FALSE(monitor.test());
  EXPECT_TRUE(monitor.segments().empty());
  monitor.add(frameAt(4, 0.1, 0.1));
  EXPECT_FALSE(monitor.test()) << "a single frame is not compared";
}

}  // namespace
}  // namespace urban_nav_trust
