// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/transform_broadcaster.h>
#include <urban_nav_msgs/StageStatus.h>

#include <memory>
#include <string>

#include "swf_vo/frame.hpp"
#include "tracks_picture.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace swf_vo {

/// Frame -> messages and tf. Used by the worker alone.
class Publisher {
 public:
  struct Frames {
    std::string odom, base, camera;
    bool publish_tf = true;
  };
  explicit Publisher(ros::NodeHandle& nh);

  /// Forgets the path and the tracks of the session before.
  void startSession(const Frames& frames, double near_disparity_px);
  void publish(const Frame& frame, const urban_nav_core::StereoPair& pair, double process_ms);
  void publish(const Settled& settled);

 private:
  void publishOdometry(const Frame& frame);
  void publishFrame(const Frame& frame, double process_ms);
  void publishStatus(const Frame& frame);
  void publishPath(const Frame& frame);
  void publishLandmarks(const Frame& frame);
  void publishTracks(const Frame& frame, const urban_nav_core::ImageView& left);

  ros::Publisher odometry_, relative_, frame_, landmarks_, tracks_, path_, status_;
  tf2_ros::TransformBroadcaster broadcaster_;
  Frames frames_;
  nav_msgs::Path way_;
  urban_nav_msgs::StageStatus last_status_;
  std::unique_ptr<TracksPicture> picture_;
};

}  // namespace swf_vo
