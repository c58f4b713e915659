// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/transform_broadcaster.h>

#include <chrono>
#include <string>

#include "live/live_laser_odometry.hpp"
#include "urban_nav_ros/stage_node.hpp"

namespace laser_odometry {

/// Converts poses to messages and tf. Used by one thread.
class Publisher {
 public:
  struct Frames {
    std::string odom, base;
    bool publish_tf = false;
  };
  /// `node` must outlive it.
  Publisher(urban_nav_ros::StageNode& node, Frames frames);

  /// `session`: session of the pose; null: not announced.
  void publish(const LaserPose& pose, const urban_nav_core::OdometrySessionPtr& session, double process_ms);
  /// Publishes the local map if it has subscribers, at most once a second.
  void publishMap(const LiveLaserOdometry& odometry, urban_nav_core::StampNs stamp);

 private:
  void publishOdometry(const LaserPose& pose);
  void publishStatus(const LaserPose& pose, double process_ms);

  urban_nav_ros::StageNode& node_;
  const Frames frames_;
  ros::Publisher odometry_, relative_, status_, map_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::chrono::steady_clock::time_point map_due_;
};

}  // namespace laser_odometry
