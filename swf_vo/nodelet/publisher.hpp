// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <string>

#include "live/tracks_picture.hpp"
#include "swf_vo/frame.hpp"
#include "urban_nav_core/types/odometry_session.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"
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
  explicit Publisher(urban_nav_ros::StageNode& node);

  /// Begins a session with empty path and tracks. `near_disparity_px`: drawn in the warmest colour.
  void startSession(const Frames& frames, double near_disparity_px);
  void publish(const Frame& frame, const urban_nav_core::OdometrySessionPtr& session,
               const urban_nav_core::StereoPair& pair, double process_ms);
  void publish(const Settled& settled, const urban_nav_core::OdometrySessionPtr& session);

 private:
  void publishOdometry(const Frame& frame);
  void publishFrame(const Frame& frame, double process_ms);
  void publishLandmarks(const Frame& frame);
  void publishTracks(const Frame& frame, const urban_nav_core::ImageView& left);

  urban_nav_ros::StageNode& node_;
  ros::Publisher odometry_, relative_, frame_, landmarks_, tracks_, path_;
  tf2_ros::TransformBroadcaster broadcaster_;
  Frames frames_;
  nav_msgs::Path drawn_path_;
  std::unique_ptr<TracksPicture> picture_;
};

}  // namespace swf_vo
