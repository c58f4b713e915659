// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/NavSatFix.h>
#include <tf2_msgs/TFMessage.h>

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/gps_reading.hpp"

namespace urban_nav_ros {

/// Converts gps/fix to fixes with the position of the antenna, using the static tf of the frame in the first message.
/// Earlier messages wait for the tf; if it is missing at the sixtieth message, the antenna is assumed at the robot's
/// origin, as offline, until the tf is received. Messages without a fix are ignored.
class GpsFixes {
 public:
  explicit GpsFixes(std::string base_frame) : base_frame_(std::move(base_frame)) {}
  /// Returns the fixes that can be converted now, in the order of arrival.
  std::vector<urban_nav_core::PositionFix> add(const sensor_msgs::NavSatFix& message);
  std::vector<urban_nav_core::PositionFix> add(const tf2_msgs::TFMessage& message);
  /// Returns whether the position of the antenna is assumed. Thread-safe.
  bool isAssumed() const { return is_assumed_; }

 private:
  std::vector<urban_nav_core::PositionFix> takeConverted();

  const std::string base_frame_;
  StaticTransforms transforms_;
  std::optional<std::string> frame_;
  std::optional<urban_nav_core::Vector3d> p_base_;
  std::atomic<bool> is_assumed_{false};
  std::vector<urban_nav_core::PositionFix> waiting_;
};

}  // namespace urban_nav_ros
