// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/accelerometer.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::SpecificForce;

sensor_msgs::Imu imu(int i, const std::string& frame = "imu_link") {
  sensor_msgs::Imu message;
  message.header.stamp = toRosTime(std::int64_t{10'000'000} * i);
  message.header.frame_id = frame;
  message.linear_acceleration.x = 9.8;
  message.linear_acceleration.y = i;
  return message;
}

/// The device is mounted with its x axis up.
tf2_msgs::TFMessage place() {
  const Pose T(urban_nav_core::expSo3(Eigen::Vector3d(0.0, -M_PI_2, 0.0)), Eigen::Vector3d(0.1, 0.2, 0.3));
  tf2_msgs::TFMessage message;
  message.transforms.push_back(toStaticTransform("base_link", "imu_link", T));
  return message;
}

TEST(Accelerometer, TurnsIntoTheAxesOfTheRobotAndWaitsForItsPlace) {
  Accelerometer accelerometer("base_link");
  EXPECT_TRUE(accelerometer.add(imu(1)).empty());
  EXPECT_TRUE(accelerometer.add(imu(2)).empty());
  EXPECT_TRUE(accelerometer.add(tf2_msgs::TFMessage()).empty());
  const std::vector<SpecificForce> waited = accelerometer.add(place());
  ASSERT_EQ(waited.size(), 2u);
  EXPECT_EQ(waited[1].stamp, 20'000'000);
  EXPECT_TRUE(waited[1].force.isApprox(Eigen::Vector3d(0.0, 2.0, 9.8), 1e-12)) << waited[1].force.transpose();
  EXPECT_EQ(accelerometer.add(imu(3)).size(), 1u);
}

TEST(Accelerometer, WithoutOneOrWithoutItsPlaceThereIsNothing) {
  Accelerometer accelerometer("base_link");
  accelerometer.add(place());
  sensor_msgs::Imu none = imu(1);
  none.linear_acceleration_covariance[0] = -1.0;
  EXPECT_TRUE(accelerometer.add(none).empty());
  Accelerometer elsewhere("base_link");
  elsewhere.add(place());
  for (int i = 0; i < 70'000; ++i) EXPECT_TRUE(elsewhere.add(imu(i, "other")).empty());
}

}  // namespace
}  // namespace urban_nav_ros
