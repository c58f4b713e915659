// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/ground_normals.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace urban_nav_ros {
namespace {

urban_nav_msgs::GroundPlane makePlane(int second) {
  urban_nav_msgs::GroundPlane message;
  message.header.stamp = ros::Time(second, 0);
  message.header.frame_id = "camera";
  message.up.y = -1.0;
  message.height = 1.2;
  message.covariance[0] = 1e-6;
  message.covariance[10] = 4e-6;
  message.support = 0.9;
  return message;
}

tf2_msgs::TFMessage makeMounting() {
  tf2_msgs::TFMessage message;
  const urban_nav_core::Pose T_base_camera(opticalInBody().R(), Eigen::Vector3d(0.3, 0.1, 1.2));
  message.transforms.push_back(toStaticTransform("base_link", "camera", T_base_camera));
  return message;
}

TEST(GroundNormals, WaitForTheMountingAndTurnIntoTheAxesOfTheRobot) {
  GroundNormals normals("base_link");
  EXPECT_TRUE(normals.add(makePlane(1)).empty());
  EXPECT_TRUE(normals.add(makePlane(2)).empty());
  const auto made = normals.add(makeMounting());
  ASSERT_EQ(made.size(), 2U);
  EXPECT_EQ(made[0].stamp, 1'000'000'000);
  EXPECT_NEAR((made[0].up - Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(made[0].height, 0.0, 1e-12) << "base_link is on the ground";
  EXPECT_NEAR(made[0].sigma, 2e-3, 1e-12);
  EXPECT_EQ(made[0].support, 0.9);
  EXPECT_EQ(normals.add(makePlane(3)).size(), 1U);
}

TEST(GroundNormals, IgnoreWhatIsNoPlane) {
  GroundNormals normals("base_link");
  normals.add(makeMounting());
  auto none = makePlane(1), infinite = makePlane(2), long_normal = makePlane(3);
  none.verdict = urban_nav_msgs::GroundPlane::NO_PLANE;
  infinite.covariance[0] = std::numeric_limits<double>::quiet_NaN();
  long_normal.up.y = -2.0;
  for (const auto& each : {none, infinite, long_normal}) EXPECT_TRUE(normals.add(each).empty());
  EXPECT_EQ(normals.add(makePlane(4)).size(), 1U);
}

}  // namespace
}  // namespace urban_nav_ros
