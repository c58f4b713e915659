// SPDX-License-Identifier: BSD-3-Clause
#include "recording/bag_contents.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>

#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

using testing::TemporaryFolder;
using urban_nav_core::Pose;

tf2_msgs::TFMessage linkMessage(const std::string& parent, const std::string& child, double x) {
  tf2_msgs::TFMessage message;
  message.transforms.push_back(
      urban_nav_ros::toStaticTransform(parent, child, Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0, 0))));
  return message;
}

TEST(BagContents, LinksOfTfThatDoNotChangeComplementTheStaticOnes) {
  const TemporaryFolder folder;
  {
    rosbag::Bag bag(folder.file("a.bag"), rosbag::bagmode::Write);
    bag.write("/tf_static", ros::Time(100.0), linkMessage("base_link", "imu", 0.5));
    for (int i = 0; i < 3000; ++i) {
      const ros::Time time(100.0 + 0.01 * i);
      bag.write("/tf", time, linkMessage("odom", "base_link", 0.01 * i));
      bag.write("/tf", time, linkMessage("base_link", "camera", 0.2));
      bag.write("/tf", time, linkMessage("base_link", "imu", 0.7));  // contradicts /tf_static
      bag.write("/tf", time, linkMessage("base_link", "head", i < 1500 ? 0.1 : 0.3));
    }
  }
  Recording recording(folder.file("a.bag"));
  const urban_nav_ros::StaticTransforms transforms = readTransforms(recording);
  ASSERT_TRUE(transforms.lookup("base_link", "camera"));
  EXPECT_DOUBLE_EQ(transforms.lookup("base_link", "camera")->t().x(), 0.2);
  EXPECT_DOUBLE_EQ(transforms.lookup("base_link", "imu")->t().x(), 0.5);
  EXPECT_FALSE(transforms.lookup("base_link", "head")) << "it moves";
  EXPECT_FALSE(transforms.lookup("odom", "camera")) << "the robot moves";
  EXPECT_EQ(recording.topicTypes().at("/tf"), "tf2_msgs/TFMessage");
}

}  // namespace
}  // namespace urban_nav_input
