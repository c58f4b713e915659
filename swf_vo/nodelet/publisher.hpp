// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>

#include <memory>
#include <string>

#include "live/tracks_picture.hpp"
#include "swf_vo/frame.hpp"
#include "swf_vo/propagation.hpp"
#include "urban_nav_core/types/odometry_session.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"
#include "urban_nav_ros/odometry_publisher.hpp"
#include "urban_nav_ros/stage_node.hpp"

namespace swf_vo {

/// Converts frames to messages and tf. Used by one thread.
class Publisher {
 public:
  struct Frames {
    std::string odom, base, camera;
    bool publish_tf = true;
  };
  /// `node` must outlive it.
  /// `imu_rate`: poses between frames are published.
  Publisher(urban_nav_ros::StageNode& node, bool imu_rate);

  /// Begins a session with empty path and tracks. `near_disparity_px`: drawn in the warmest colour.
  void startSession(const Frames& frames, double near_disparity_px);
  void publish(const Frame& frame, const urban_nav_core::OdometrySessionPtr& session,
               const urban_nav_core::StereoPair& pair, double process_ms);
  void publish(const Settled& settled, const urban_nav_core::OdometrySessionPtr& session);
  void publish(const PropagatedPose& pose);

 private:
  void publishFrame(const Frame& frame, double process_ms);
  void publishLandmarks(const Frame& frame);
  void publishTracks(const Frame& frame, const urban_nav_core::ImageView& left);

  urban_nav_ros::StageNode& node_;
  urban_nav_ros::OdometryPublisher odometry_;
  ros::Publisher relative_, frame_, landmarks_, tracks_, path_;
  Frames frames_;
  nav_msgs::Path drawn_path_;
  std::unique_ptr<TracksPicture> picture_;
};

}  // namespace swf_vo
