// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <optional>
#include <string>
#include <vector>

#include "pose_graph/level.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace pose_graph {

/// imu/data as what was felt in the axes of the robot: by the static tf of the frame that the first message names, as offline. Messages that
/// come before it wait. What says that it has no accelerometer gives nothing.
class Accelerometer {
 public:
  explicit Accelerometer(std::string base_frame) : base_frame_(std::move(base_frame)) {}
  /// What can be told from now on, in the order in which it came.
  std::vector<SpecificForce> add(const sensor_msgs::Imu& message);
  std::vector<SpecificForce> add(const tf2_msgs::TFMessage& message);

 private:
  std::vector<SpecificForce> turned();

  const std::string base_frame_;
  urban_nav_ros::StaticTransforms transforms_;
  std::optional<std::string> frame_;
  std::optional<urban_nav_core::Matrix3d> R_base_imu_;
  std::vector<SpecificForce> waiting_;  ///< in the axes of the device
};

}  // namespace pose_graph
