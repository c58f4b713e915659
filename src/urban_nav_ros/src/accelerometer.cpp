// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/accelerometer.hpp"

#include <utility>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::SpecificForce;

namespace {

// Without tf: ten minutes at 100 Hz.
constexpr std::size_t kMostWaiting = 60'000;

}  // namespace

std::vector<SpecificForce> Accelerometer::add(const sensor_msgs::Imu& message) {
  if (!frame_) frame_ = message.header.frame_id;
  // sensor_msgs/Imu: element 0 is -1 without an accelerometer.
  if (message.linear_acceleration_covariance[0] < 0.0 || waiting_.size() >= kMostWaiting) return {};
  const auto& force = message.linear_acceleration;
  waiting_.push_back({toStampNs(message.header.stamp), {force.x, force.y, force.z}});
  return takeConverted();
}

std::vector<SpecificForce> Accelerometer::add(const tf2_msgs::TFMessage& message) {
  transforms_.add(message);
  return takeConverted();
}

std::vector<SpecificForce> Accelerometer::takeConverted() {
  if (!R_base_imu_ && frame_)
    if (const auto T_base_imu = transforms_.lookup(base_frame_, *frame_)) R_base_imu_ = T_base_imu->R();
  if (!R_base_imu_) return {};
  std::vector<SpecificForce> made = std::exchange(waiting_, {});
  for (SpecificForce& sample : made) sample.force = *R_base_imu_ * sample.force;
  return made;
}

}  // namespace urban_nav_ros
