// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_trust.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace urban_nav_trust {
namespace {

using urban_nav_core::Health;

constexpr urban_nav_core::StampNs kLiveFrame = 50'000'000;

/// Robot at 1 m/s whose odometry has 20 frames a second.
class LiveTrustTest : public ::testing::Test {
 protected:
  void drive(int frames, double step_px = 0.0, Health health = Health::Ok, double sigma_px = 0.03) {
    for (int i = 0; i < frames; ++i) {
      ++k_;
      LiveFrame frame{k_ * kLiveFrame, true, health, {}};
      frame.compared.stamp = frame.stamp;
      frame.compared.disparity_step_px = step_px + (k_ % 2 == 0 ? 0.01 : -0.01);
      frame.compared.disparity_step_sigma_px = sigma_px;
      frame.compared.right_turn = turn;
      frame.compared.reprojection_px = reprojection_px;
      frame.compared.turn_sigma = 1e-3;
      frame.compared.forward = 0.05;
      frame.compared.forward_sigma = has_wheels ? 1e-3 : 0.0;
      LiveStep step;
      step.stamp = step.step.to = frame.stamp;
      step.step.drift_covariance = 1e-8 * urban_nav_core::Matrix6d::Identity();
      trust.add(step);
      trust.add(frame);
      LivePose pose;
      pose.stamp = k_ * kLiveFrame;
      pose.T_odom_base.pose =
          urban_nav_core::Pose(Eigen::Quaterniond::Identity(), {0.05 * static_cast<double>(k_), 0.0, 0.0});
      pose.T_odom_base.covariance = 1e-6 * urban_nav_core::Matrix6d::Identity();
      trust.add(pose);
    }
  }

  std::vector<LiveEstimate> estimates;
  LiveTrust trust{Parameters(), [this](const LiveEstimate& estimate) { estimates.push_back(estimate); }};
  bool has_wheels = true;
  double reprojection_px = 0.3;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  urban_nav_core::StampNs k_ = 0;
};

TEST_F(LiveTrustTest, IsUnsureUntilSomethingIsComparedAndThenKnown) {
  EXPECT_TRUE(trust.report().is_warning);
  drive(1);
  ASSERT_EQ(estimates.size(), 1U);
  EXPECT_EQ(estimates[0].frame.state, TrustState::Unsure);
  EXPECT_FALSE(estimates[0].reason.empty());
  EXPECT_FALSE(estimates[0].results.absent.empty());
  drive(60);
  EXPECT_EQ(estimates.back().frame.state, TrustState::Known);
  EXPECT_GT(estimates.back().frame.probabilities[0], 0.99);
  const std::size_t before = estimates.size();
  drive(100);
  EXPECT_EQ(estimates.size(), before + 5) << "one per second without changes";
  EXPECT_EQ(trust.status().health, Health::Ok);
}

TEST_F(LiveTrustTest, WithAGyroscopeAloneItIsUnsureOfLengthsAndNamesWhatIsMissing) {
  has_wheels = false;
  drive(200);
  const LiveEstimate& last = estimates.back();
  EXPECT_EQ(last.frame.state, TrustState::Unsure);
  EXPECT_NE(last.reason.find("lengths"), std::string::npos) << last.reason;
  EXPECT_NE(last.reason.find("wheel_speed"), std::string::npos) << last.reason;
  const auto isAbsent = [&](const std::string& name) {
    return std::any_of(last.results.absent.begin(), last.results.absent.end(),
                       [&](const AbsentMeasurement& absent) { return absent.name == name && !absent.reason.empty(); });
  };
  for (const char* name : {"wheel_speed", "laser_sides", "stereo_laser_scale", "lidar_odometry", "gps_position"})
    EXPECT_TRUE(isAbsent(name)) << name;
}

TEST_F(LiveTrustTest, AKnockDegradesWithinASecondAndStays) {
  drive(200);
  drive(1, -1.36);
  estimates.clear();
  drive(9, -1.36);
  drive(200);
  ASSERT_FALSE(estimates.empty());
  EXPECT_LE(estimates[0].frame.stamp, 220 * kLiveFrame);
  for (const LiveEstimate& estimate : estimates) {
    EXPECT_EQ(estimate.frame.state, TrustState::Unsure);
    EXPECT_EQ(estimate.frame.tests, kOffsetTest);
  }
  EXPECT_LT(estimates.back().frame.probabilities[0], estimates.front().frame.probabilities[0]);
  const urban_nav_core::Status status = trust.status();
  EXPECT_EQ(status.health, Health::Degraded);
  EXPECT_STREQ(toString(static_cast<Reason>(status.reason)), "calibration_changed");
  trust.reset();
  EXPECT_EQ(trust.status().health, Health::Ok);
}

TEST_F(LiveTrustTest, AKnockThatOdometryCorrectsDegradesUntilTheLandmarksAreRenewed) {
  drive(200);
  const double before = estimates.back().frame.probabilities[0];
  turn.y() = -0.0035;
  drive(20, -1.36);
  EXPECT_EQ(estimates.back().frame.state, TrustState::Unsure);
  EXPECT_EQ(estimates.back().frame.tests, kOffsetTest);
  EXPECT_EQ(trust.status().health, Health::Degraded);
  drive(60);
  EXPECT_EQ(estimates.back().frame.state, TrustState::Known);
  EXPECT_TRUE(estimates.back().reason.empty()) << estimates.back().reason;
  EXPECT_NEAR(estimates.back().frame.probabilities[0], before, 1e-6);
  EXPECT_EQ(trust.status().health, Health::Ok);
  drive(60, 1.0);  // a second knock, which odometry does not correct
  drive(100);
  EXPECT_EQ(estimates.back().frame.state, TrustState::Unsure);
  EXPECT_LT(estimates.back().frame.probabilities[0], before);
  EXPECT_EQ(trust.status().health, Health::Degraded);
}

TEST_F(LiveTrustTest, AReprojectionErrorThatRisesForGoodIsNamed) {
  drive(400);
  EXPECT_EQ(estimates.back().frame.state, TrustState::Known);
  reprojection_px = 3.0;
  drive(200);
  EXPECT_EQ(estimates.back().frame.state, TrustState::Unsure);
  EXPECT_EQ(estimates.back().frame.tests, kReprojectionTest);
  EXPECT_EQ(trust.status().health, Health::Degraded);
}

TEST_F(LiveTrustTest, IsNeverKnownWhileOdometryIsLost) {
  drive(50);
  drive(10, 0.0, Health::Lost, 0.0);
  EXPECT_EQ(estimates.back().frame.state, TrustState::Lost);
  EXPECT_EQ(trust.status().health, Health::Lost);
  drive(30);
  EXPECT_EQ(estimates.back().frame.state, TrustState::Known);
}

TEST_F(LiveTrustTest, TimeGoingBackBeginsANewSession) {
  drive(200);
  drive(10, -1.36);
  k_ = 0;
  drive(60);
  EXPECT_EQ(estimates.back().frame.state, TrustState::Known);
  EXPECT_EQ(trust.status().health, Health::Ok);
}

}  // namespace
}  // namespace urban_nav_trust
