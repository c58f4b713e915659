// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/motion.hpp"

#include <cmath>

#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::MotionInput;
using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

namespace {

// Resolution of typical encoders per message: 1 mm, 1 mrad.
constexpr double kResolution = 1e-3;

double toInformation(double sigma) { return 1.0 / (sigma * sigma); }

/// Returns the standard deviation of a rate stated by the message, rad/s; 0 if it is missing or implausible.
double statedNoise(const sensor_msgs::Imu& message) {
  constexpr double kLeast = 1e-5, kMost = 10.0;  // rad/s
  const auto& covariance = message.angular_velocity_covariance;
  const double variance = (covariance[0] + covariance[4] + covariance[8]) / 3.0;
  return variance > kLeast * kLeast && variance < kMost * kMost ? std::sqrt(variance) : 0.0;
}

/// Returns the specific force in the axes of base_link, m/s^2; zero where the message has none.
Vector3d toSpecificForce(const sensor_msgs::Imu& message, const urban_nav_core::Matrix3d& R_base_imu) {
  const Vector3d force(message.linear_acceleration.x, message.linear_acceleration.y, message.linear_acceleration.z);
  const bool absent = message.linear_acceleration_covariance[0] < 0.0;  // sensor_msgs/Imu: -1 without accelerometer
  if (absent || !force.allFinite()) return Vector3d::Zero();
  return R_base_imu * force;
}

}  // namespace

std::optional<MotionInput> WheelMotion::add(const nav_msgs::Odometry& message) {
  const std::optional<Pose> pose = toPose(message.pose.pose);
  const StampNs stamp = toStampNs(message.header.stamp);
  if (!pose || (last_ && stamp <= last_->stamp)) return std::nullopt;
  const std::optional<Last> last = last_;
  last_ = Last{stamp, *pose};
  if (!last) return std::nullopt;

  MotionInput input;
  input.source = urban_nav_core::MotionSource::Wheels;
  input.from = last->stamp;
  input.to = stamp;
  input.T_from_to = last->T_odom_base.inverse() * *pose;
  const double distance = input.T_from_to.t().norm();
  const double angle = urban_nav_core::angleBetween(input.T_from_to, Pose());
  const double along = toInformation(kResolution + noise_ * distance);
  input.information.diagonal() << along, along, 0.0, 0.0, 0.0, toInformation(kResolution + noise_ * angle);
  return input;
}

std::optional<MotionInput> GyroMotion::add(const sensor_msgs::Imu& message) {
  const Vector3d measured(message.angular_velocity.x, message.angular_velocity.y, message.angular_velocity.z);
  const StampNs stamp = toStampNs(message.header.stamp);
  const bool absent =
      message.angular_velocity_covariance[0] < 0.0;  // sensor_msgs/Imu: element 0 is -1 without a gyroscope
  if (absent || !measured.allFinite() || (last_ && stamp <= last_->stamp)) return std::nullopt;
  const Vector3d rate = R_base_imu_ * measured;
  const std::optional<Last> last = last_;
  last_ = Last{stamp, rate};
  if (!last) return std::nullopt;

  MotionInput input;
  input.source = urban_nav_core::MotionSource::Gyroscope;
  input.q_base_sensor = Quaterniond(R_base_imu_);
  input.from = last->stamp;
  input.to = stamp;
  const double seconds = urban_nav_core::secondsBetween(input.from, input.to);
  input.T_from_to = Pose(urban_nav_core::expSo3(0.5 * seconds * (last->rate + rate)), Vector3d::Zero());
  input.specific_force = toSpecificForce(message, R_base_imu_);
  const double noise = noise_ > 0.0 ? noise_ : statedNoise(message);
  if (noise > 0.0) input.information.diagonal().tail<3>().setConstant(toInformation(noise * seconds));
  return input;
}

}  // namespace urban_nav_ros
