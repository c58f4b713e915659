// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::isApprox;
using urban_nav_core::Matrix3d;
using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

constexpr StampNs kSecond = 1'000'000'000;

nav_msgs::Odometry odometry(StampNs stamp, const Pose& pose) {
  nav_msgs::Odometry message;
  message.header.stamp = toRosTime(stamp);
  message.pose.pose = toPoseMessage(pose);
  return message;
}

sensor_msgs::Imu imu(StampNs stamp, const Vector3d& rate) {
  sensor_msgs::Imu message;
  message.header.stamp = toRosTime(stamp);
  message.angular_velocity.x = rate.x();
  message.angular_velocity.y = rate.y();
  message.angular_velocity.z = rate.z();
  return message;
}

TEST(WheelMotion, IncrementsMultiplyUpToThePoses) {
  WheelMotion wheels(0.05);
  Pose sum;
  const Pose first(Quaterniond(Eigen::AngleAxisd(0.3, Vector3d::UnitZ())), Vector3d(5, -2, 0));
  Pose pose = first;
  EXPECT_FALSE(wheels.add(odometry(10 * kSecond, pose)));
  for (int i = 1; i <= 10; ++i) {
    pose = pose * Pose(Quaterniond(Eigen::AngleAxisd(0.1, Vector3d::UnitZ())), Vector3d(0.2, 0, 0));
    const auto input = wheels.add(odometry(10 * kSecond + i * kSecond / 20, pose));
    ASSERT_TRUE(input);
    EXPECT_EQ(input->to - input->from, kSecond / 20);
    EXPECT_NEAR(input->information(0, 0), 1.0 / std::pow(0.001 + 0.05 * 0.2, 2), 1e-3);
    EXPECT_NEAR(input->information(5, 5), 1.0 / std::pow(0.001 + 0.05 * 0.1, 2), 1e-3);
    EXPECT_EQ(input->information(2, 2), 0.0);
    EXPECT_EQ(input->information(3, 3), 0.0);
    EXPECT_EQ(input->information(4, 4), 0.0);
    sum = sum * input->T_from_to;
  }
  EXPECT_TRUE(isApprox(first * sum, pose, 1e-12));
}

TEST(WheelMotion, StampsThatDoNotAdvanceAndPosesThatAreNoneGiveNothing) {
  WheelMotion wheels(0.05);
  wheels.add(odometry(kSecond, Pose()));
  EXPECT_FALSE(wheels.add(odometry(kSecond, Pose())));
  EXPECT_FALSE(wheels.add(odometry(kSecond / 2, Pose())));
  nav_msgs::Odometry bad = odometry(2 * kSecond, Pose());
  bad.pose.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(wheels.add(bad));
  const auto input = wheels.add(odometry(3 * kSecond, Pose()));
  ASSERT_TRUE(input);
  EXPECT_EQ(input->from, kSecond);
}

TEST(GyroMotion, IntegratesTheMeanRateInBaseLink) {
  // The device faces left: its x axis is base_link's y.
  Matrix3d R_base_imu;
  R_base_imu << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  GyroMotion gyro(0.1, R_base_imu);
  EXPECT_FALSE(gyro.add(imu(kSecond, Vector3d(1.0, 0, 0))));
  const auto input = gyro.add(imu(kSecond + kSecond / 100, Vector3d(3.0, 0, 0)));
  ASSERT_TRUE(input);
  const Pose expected(Quaterniond(Eigen::AngleAxisd(0.02, Vector3d::UnitY())), Vector3d::Zero());
  EXPECT_TRUE(isApprox(input->T_from_to, expected, 1e-12));
  EXPECT_EQ(input->information(0, 0), 0.0);
  EXPECT_NEAR(input->information(4, 4), 1e6, 1e-3);
}

TEST(GyroMotion, NoiseIsThatOfTheMessagesWhereNoneIsSet) {
  GyroMotion gyro(0.0, Matrix3d::Identity());
  gyro.add(imu(kSecond, Vector3d::Zero()));
  const auto silent = gyro.add(imu(kSecond + kSecond / 100, Vector3d::Zero()));
  ASSERT_TRUE(silent);
  EXPECT_TRUE(silent->information.isZero()) << "no covariance stated";
  sensor_msgs::Imu stated = imu(kSecond + kSecond / 50, Vector3d::Zero());
  for (const std::size_t i : {0U, 4U, 8U}) stated.angular_velocity_covariance[i] = 0.04 * 0.04;
  const auto input = gyro.add(stated);
  ASSERT_TRUE(input);
  EXPECT_NEAR(input->information(5, 5), 1.0 / std::pow(0.04 * 0.01, 2), 1e-3);
}

TEST(GyroMotion, StatesItsKindAndMounting) {
  const Quaterniond mounted(Eigen::AngleAxisd(0.5, Vector3d::UnitX()));
  GyroMotion gyro(0.1, mounted.toRotationMatrix());
  gyro.add(imu(kSecond, Vector3d::Zero()));
  const auto input = gyro.add(imu(2 * kSecond, Vector3d::Zero()));
  ASSERT_TRUE(input);
  EXPECT_EQ(input->source, urban_nav_core::MotionSource::Gyroscope);
  EXPECT_LT(input->q_base_sensor.angularDistance(mounted), 1e-12);
  WheelMotion wheels(0.05);
  wheels.add(odometry(kSecond, Pose()));
  EXPECT_EQ(wheels.add(odometry(2 * kSecond, Pose()))->source, urban_nav_core::MotionSource::Wheels);
}

TEST(GyroMotion, ADeviceWithoutGyroscopeGivesNothing) {
  GyroMotion gyro(0.1, Matrix3d::Identity());
  gyro.add(imu(kSecond, Vector3d::Zero()));
  sensor_msgs::Imu absent = imu(2 * kSecond, Vector3d::Zero());
  absent.angular_velocity_covariance[0] = -1.0;
  EXPECT_FALSE(gyro.add(absent));
}

}  // namespace
}  // namespace urban_nav_ros
