// SPDX-License-Identifier: BSD-3-Clause
#include "initial_pose.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_localization {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::UserError;

/// As rviz draws it.
geometry_msgs::PoseWithCovarianceStamped drawn(double x, double y) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.frame_id = "map";
  message.pose.pose.position.x = x;
  message.pose.pose.position.y = y;
  message.pose.pose.orientation.w = 1.0;
  message.pose.covariance[0] = message.pose.covariance[7] = 0.25;
  message.pose.covariance[35] = 0.07;
  return message;
}

/// Uphill along x.
std::vector<urban_nav_store::StoredTrajectory> hill() {
  urban_nav_store::StoredTrajectory session;
  for (int i = 0; i < 10; ++i)
    session.T_map_base.push_back({i, Pose(Quaterniond::Identity(), {static_cast<double>(i), 0.0, 0.1 * i})});
  return {session};
}

TEST(InitialPose, ADrawnOneIsPutAtTheHeightOfTheMap) {
  const auto initial_pose = toInitialPose(drawn(6.2, 1.0), "map", "initialpose", hill());
  EXPECT_NEAR(initial_pose.pose.t().z(), 0.6, 1e-12);
  EXPECT_EQ(initial_pose.pose.t().x(), 6.2);
  EXPECT_GT(initial_pose.covariance.diagonal().minCoeff(), 0.0);
  EXPECT_NEAR(initial_pose.covariance(0, 0), 0.25, 1e-3);
  EXPECT_GE(initial_pose.covariance(2, 2), 1.0);
  EXPECT_EQ(toInitialPose(drawn(6.2, 1.0), "/map", "initialpose", {}).pose.t().z(), 0.0);
}

TEST(InitialPose, AWholeOneStaysAsItIs) {
  auto message = drawn(6.0, 0.0);
  message.pose.pose.position.z = 3.0;
  message.pose.covariance[14] = message.pose.covariance[21] = message.pose.covariance[28] = 0.04;
  const auto initial_pose = toInitialPose(message, "map", "initialpose", hill());
  EXPECT_EQ(initial_pose.pose.t().z(), 3.0);
  EXPECT_NEAR(initial_pose.covariance(2, 2), 0.04, 1e-3);
  EXPECT_NEAR(initial_pose.covariance(3, 3), 0.04, 1e-3);
}

TEST(InitialPose, WhatIsNoneIsNamed) {
  const auto refused = [](const geometry_msgs::PoseWithCovarianceStamped& message, const std::string& words) {
    try {
      toInitialPose(message, "map", "initialpose", {});
      return false;
    } catch (const UserError& error) {
      return std::string(error.what()).find(words) != std::string::npos;
    }
  };
  auto message = drawn(0.0, 0.0);
  message.header.frame_id = "odom";
  EXPECT_TRUE(refused(message, "`odom`"));
  message = drawn(std::numeric_limits<double>::quiet_NaN(), 0.0);
  EXPECT_TRUE(refused(message, "pose"));
  message = drawn(0.0, 0.0);
  message.pose.pose.orientation.w = 0.0;
  EXPECT_TRUE(refused(message, "quaternion"));
  message = drawn(0.0, 0.0);
  message.pose.covariance[0] = -1.0;
  EXPECT_TRUE(refused(message, "covariance"));
  message = drawn(0.0, 0.0);
  message.pose.covariance[1] = 0.1;
  EXPECT_TRUE(refused(message, "symmetric"));
  message = drawn(0.0, 0.0);
  message.pose.covariance[7] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(refused(message, "covariance"));
}

}  // namespace
}  // namespace urban_nav_localization
