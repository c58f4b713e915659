// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/specific_force.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_ros {

/// Converts imu/data to specific force in the axes of the robot, by the static tf of the frame in the first message, as
/// offline. Earlier messages wait for the tf. Messages without an accelerometer are ignored.
class Accelerometer {
 public:
  explicit Accelerometer(std::string base_frame) : base_frame_(std::move(base_frame)) {}
  /// Returns the samples that can be converted now, in the order of arrival.
  std::vector<urban_nav_core::SpecificForce> add(const sensor_msgs::Imu& message);
  std::vector<urban_nav_core::SpecificForce> add(const tf2_msgs::TFMessage& message);

 private:
  std::vector<urban_nav_core::SpecificForce> takeConverted();

  const std::string base_frame_;
  StaticTransforms transforms_;
  std::optional<std::string> frame_;
  std::optional<urban_nav_core::Matrix3d> R_base_imu_;
  std::vector<urban_nav_core::SpecificForce> waiting_;  ///< in the axes of the device
};

}  // namespace urban_nav_ros
