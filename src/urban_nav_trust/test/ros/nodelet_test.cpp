// SPDX-License-Identifier: BSD-3-Clause
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/StageStatus.h>
#include <urban_nav_msgs/Trust.h>
#include <urban_nav_msgs/VoStatistics.h>
#include <visualization_msgs/MarkerArray.h>

#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/listener.hpp"
#include "urban_nav_ros/testing/receipts.hpp"

namespace urban_nav_trust {
namespace {

using urban_nav_msgs::Trust;

constexpr urban_nav_core::StampNs kFrame = 50'000'000;

/// Odometry of a robot, and the state published by the nodelet.
class TrustGraph : public urban_nav_ros::testing::Listener {
 public:
  TrustGraph() : Listener("trust"), receipts_("trust") {
    keep("trust/state", states);
    keep("trust/status", statuses);
    keep("trust/markers", markers);
  }
  void diagnose(int level, const std::string& message, double seconds) {
    diagnostic_msgs::DiagnosticArray array;
    array.header.stamp.fromSec(seconds);
    array.status.resize(1);
    array.status[0].name = "swf_vo: frames";
    array.status[0].level = static_cast<signed char>(level);
    array.status[0].message = message;
    diagnostics_.publish(array);
  }
  void drive(int frames, double step_px) {
    for (int i = 0; i < frames; ++i) {
      ++k_;
      urban_nav_msgs::VoStatistics statistics;
      statistics.header.stamp = urban_nav_ros::toRosTime(k_ * kFrame);
      statistics.accepted = 1;
      statistics.status = urban_nav_msgs::VoStatistics::OK;
      statistics.disparity_step_px = step_px + (k_ % 2 == 0 ? 0.01 : -0.01);
      statistics.disparity_step_sigma_px = 0.03;
      statistics.turn_sigma = 1e-3;
      statistics.forward = 0.05;
      statistics.forward_sigma = 1e-3;
      const nav_msgs::Odometry odometry = urban_nav_ros::toOdometryMessage(
          k_ * kFrame,
          {urban_nav_core::Pose(Eigen::Quaterniond::Identity(), {0.05 * static_cast<double>(k_), 0.0, 0.0}),
           1e-6 * urban_nav_core::Matrix6d::Identity()},
          "odom", "base_link");
      urban_nav_core::SessionStep step;
      step.from = (k_ - 1) * kFrame;
      step.to = k_ * kFrame;
      step.drift_covariance = 1e-8 * urban_nav_core::Matrix6d::Identity();
      EXPECT_TRUE(receipts_.await({{"odometry/relative_pose", 1}},
                                  [&] { relative_.publish(urban_nav_ros::toRelativePoseMessage(step, "base_link")); }));
      EXPECT_TRUE(receipts_.await({{"vo/statistics", 1}}, [&] { statistics_.publish(statistics); }));
      EXPECT_TRUE(receipts_.await({{"odometry", 1}}, [&] { odometry_.publish(odometry); }));
    }
  }

  std::vector<Trust> states;
  std::vector<urban_nav_msgs::StageStatus> statuses;
  std::vector<visualization_msgs::MarkerArray> markers;

 private:
  const urban_nav_ros::testing::Receipts receipts_;
  ros::Publisher statistics_ = advertise<urban_nav_msgs::VoStatistics>("vo/statistics");
  ros::Publisher relative_ = advertise<urban_nav_msgs::RelativePose>("odometry/relative_pose");
  ros::Publisher diagnostics_ = advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics");
  ros::Publisher odometry_ = advertise<nav_msgs::Odometry>("odometry");
  urban_nav_core::StampNs k_ = 100;
};

TEST(TrustNodelet, StatesWhatAKnockToACameraIsWorth) {
  TrustGraph graph;
  ASSERT_TRUE(TrustGraph::until([&] { return graph.isConnected(); }));
  graph.drive(60, 0.0);
  ASSERT_TRUE(TrustGraph::until([&] { return !graph.states.empty() && graph.states.back().state == Trust::KNOWN; }));
  const Trust known = graph.states.back();
  EXPECT_EQ(known.header.frame_id, "map");
  ASSERT_EQ(known.probabilities.size(), 3U);
  ASSERT_EQ(known.radii.size(), 3U);
  EXPECT_GT(known.probabilities[0], 0.9);
  ASSERT_FALSE(known.tests.empty());
  EXPECT_FALSE(known.tests[0].failed);

  graph.drive(5, -1.36);
  ASSERT_TRUE(TrustGraph::until([&] { return graph.states.back().state == Trust::UNSURE; }));
  const Trust unsure = graph.states.back();
  EXPECT_FALSE(unsure.reason.empty());
  ASSERT_FALSE(unsure.tests.empty());
  EXPECT_TRUE(unsure.tests[0].failed);
  EXPECT_FALSE(unsure.tests[0].remedy.empty());
  EXPECT_TRUE(TrustGraph::until(
      [&] { return !graph.statuses.empty() && graph.statuses.back().reason_name == "calibration_changed"; }));

  EXPECT_TRUE(graph.call("reset"));
  graph.drive(60, 0.0);
  EXPECT_TRUE(TrustGraph::until([&] { return graph.states.back().state == Trust::KNOWN; }));
}

TEST(TrustNodelet, ShowsInRvizWhatIsNotOk) {
  TrustGraph graph;
  ASSERT_TRUE(TrustGraph::until([&] { return graph.isConnected(); }));
  const double now = ros::Time::now().toSec();
  const auto shows = [&](const std::string& text, float red) {
    if (graph.markers.empty() || graph.markers.back().markers.empty()) return false;
    const visualization_msgs::Marker& marker = graph.markers.back().markers.back();
    return marker.text.find(text) != std::string::npos && marker.color.r >= red &&
           marker.header.frame_id == "base_link";
  };
  graph.diagnose(2, "both cameras are silent", now);
  EXPECT_TRUE(TrustGraph::until([&] { return shows("swf_vo: frames: both cameras are silent", 0.9F); }));
  graph.diagnose(0, "OK", now + 0.5);
  EXPECT_TRUE(TrustGraph::until([&] { return !shows("swf_vo", 0.0F); }));
}

}  // namespace
}  // namespace urban_nav_trust

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "urban_nav_trust_nodelet_test");
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
