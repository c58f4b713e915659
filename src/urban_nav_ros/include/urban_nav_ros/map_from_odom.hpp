// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/transform_broadcaster.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_ros {

/// Publishes map -> odom on /tf for the stage that estimates it. Thread-safe.
class MapFromOdom {
 public:
  MapFromOdom(std::string map_frame, std::string odom_frame);

  /// Sets the transform; empty: unknown.
  void set(const std::optional<urban_nav_core::Pose>& T_map_odom);
  /// Publishes the transform with the stamp of an odometry message, so that every odom -> base_link has a matching map
  /// -> odom. While it is unknown, stamps are kept and published once it is set.
  void send(urban_nav_core::StampNs stamp);

 private:
  void sendAll(const std::vector<urban_nav_core::StampNs>& stamps);

  const std::string map_frame_, odom_frame_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::mutex mutex_;  // guards the broadcaster and all members below
  std::vector<urban_nav_core::StampNs> unsent_;
  std::optional<urban_nav_core::Pose> T_map_odom_;
};

}  // namespace urban_nav_ros
