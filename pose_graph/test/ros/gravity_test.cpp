// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <urban_nav_msgs/GetTrajectory.h>

#include "listener.hpp"
#include "urban_nav_ros/graph.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace pose_graph::test {
namespace {

using urban_nav_core::StampNs;

constexpr StampNs kFirst = 1'225'719'873'000'000'000, kStep = 100'000'000;
constexpr int kSteps = 100;

/// Drives straight ahead.
void drive(const Listener& listener) {
  for (int i = 0; i < kSteps; ++i) {
    urban_nav_core::RelativePose step;
    step.from = kFirst + i * kStep;
    step.to = step.from + kStep;
    step.T_from_to = urban_nav_core::Pose(urban_nav_core::Quaterniond::Identity(), Eigen::Vector3d(0.1, 0.0, 0.0));
    step.covariance = 1e-4 * urban_nav_core::Matrix6d::Identity();
    step.source = "swf_vo";
    listener.relative.publish(urban_nav_ros::toRelativePoseMessage(step, "base_link"));
  }
}

bool isNamed(const Listener& listener) {
  for (const auto& array : listener.diagnostics)
    for (const auto& status : array.status)
      if (status.message.find("NED") != std::string::npos && status.level == diagnostic_msgs::DiagnosticStatus::WARN)
        return true;
  return false;
}

/// The frame of the messages is base_link, so no tf is needed.
TEST(PoseGraphGravity, AnAccelerometerWithTheSignOfNedIsReportedAndDoesNotInvertTheMap) {
  Listener listener;
  ASSERT_TRUE(listener.connected());
  ASSERT_TRUE(listener.call("reset"));
  sensor_msgs::Imu message;
  message.header.frame_id = "base_link";
  message.linear_acceleration.z = -9.81;
  for (int i = 0; i <= 10 * kSteps; ++i) {
    message.header.stamp = urban_nav_ros::toRosTime(kFirst + i * (kStep / 10));
    listener.imu.publish(message);
  }
  drive(listener);
  EXPECT_TRUE(Listener::until([&] { return isNamed(listener); }))
      << (listener.diagnostics.empty() ? "no diagnostics" : listener.diagnostics.back().status.front().message);
  EXPECT_TRUE(Listener::until([&] { return listener.diagnosed("specific forces not used", "1001"); }));
  urban_nav_msgs::GetTrajectory call;
  const auto poses = [&]() -> std::size_t {
    if (!ros::service::call("pose_graph/get_trajectory", call) || call.response.segments.empty()) return 0;
    return call.response.segments[0].stamps.size();
  };
  ASSERT_TRUE(Listener::until([&] { return poses() == kSteps + 1; }));
  const auto first = urban_nav_ros::toPose(call.response.segments[0].T_map_base[0]);
  ASSERT_TRUE(first);
  EXPECT_GT((first->R() * Eigen::Vector3d::UnitZ()).z(), 0.99);
}

}  // namespace
}  // namespace pose_graph::test
