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

/// map -> odom on /tf, by whichever stage says where the map is. Thread-safe.
class MapFromOdom {
 public:
  MapFromOdom(std::string map_frame, std::string odom_frame);

  /// From now on it is this; empty: not known.
  void set(const std::optional<urban_nav_core::Pose>& T_map_odom);
  /// Publishes it with the stamp of an odometry message, so that every odom -> base_link has its map -> odom; where it
  /// is not known yet, as soon as it is.
  void send(urban_nav_core::StampNs stamp);

 private:
  void sendAll(const std::vector<urban_nav_core::StampNs>& stamps);

  const std::string map_frame_, odom_frame_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::mutex mutex_;  // guards the broadcaster and what follows
  std::vector<urban_nav_core::StampNs> unsent_;
  std::optional<urban_nav_core::Pose> T_map_odom_;
};

}  // namespace urban_nav_ros
