// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_msgs/TFMessage.h>
#include <urban_nav_msgs/GroundPlane.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/ground_normal.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_ros {

/// Converts stereo/ground_plane to normals in base_link axes, using the static tf of the frame in the first message.
/// Earlier messages wait one second for the tf; without it, base_frame is assumed at the camera, as in other
/// converters, until the tf is received. Messages without a plane and messages that are not finite are ignored.
class GroundNormals {
 public:
  explicit GroundNormals(std::string base_frame) : base_frame_(std::move(base_frame)) {}
  /// Returns the normals that can be converted now, in the order of arrival.
  std::vector<urban_nav_core::GroundNormal> add(const urban_nav_msgs::GroundPlane& message);
  std::vector<urban_nav_core::GroundNormal> add(const tf2_msgs::TFMessage& message);
  /// Returns whether the mounting of the camera is assumed. Thread-safe.
  bool isAssumed() const { return is_assumed_; }

 private:
  std::vector<urban_nav_core::GroundNormal> takeConverted();

  const std::string base_frame_;
  StaticTransforms transforms_;
  std::optional<std::string> frame_;
  std::chrono::steady_clock::time_point first_;  ///< arrival of the first message
  std::optional<urban_nav_core::Pose> T_base_camera_;
  std::atomic<bool> is_assumed_{false};
  std::vector<urban_nav_core::GroundNormal> waiting_;  ///< in the axes of the camera, and its height
};

}  // namespace urban_nav_ros
