// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>
#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/StageStatus.h>
#include <urban_nav_msgs/VoStatistics.h>

#include <vector>

#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/stereo_listener.hpp"

namespace swf_vo::test {

/// A walk through a textured room, small enough for fast rendering.
inline urban_nav_core::testing::RenderedSequence room() {
  using namespace urban_nav_core::testing;
  SequenceOptions options;
  options.camera.fx = options.camera.fy = 260.0;
  options.camera.width = 320;
  options.camera.height = 240;
  options.camera.cx = 159.5;
  options.camera.cy = 119.5;
  options.first_stamp = 1'225'719'873'123'456'789;
  return RenderedSequence(texturedRoom(), loop(3.0, 1.5, 1.2, 25.0), options);
}

/// ROS graph of the nodelet: a robot that publishes, and a listener that records everything.
class Graph : public urban_nav_ros::testing::StereoListener {
 public:
  Graph() : urban_nav_ros::testing::StereoListener("swf_vo") {
    keep("vo/odometry", odometry);
    keep("vo/relative_pose", relative);
    keep("vo/statistics", frames);
    keep("vo/landmarks", landmarks);
    keep("vo/tracks", tracks);
    keep("swf_vo/status", statuses);
    keep("/tf", transforms);
    connected_ = until([this] { return isConnected(); });
  }
  bool connected() const { return connected_; }

  void publish(const urban_nav_core::testing::StereoFrame& frame, const urban_nav_core::StereoCamera& camera,
               bool left = true, bool right = true) {
    show(frame, camera, frame.stamp, left, right);
  }

  void forget() {
    ros::spinOnce();
    odometry.clear();
    relative.clear();
    frames.clear();
    landmarks.clear();
    tracks.clear();
    transforms.clear();
    diagnostics.clear();
  }

  std::vector<nav_msgs::Odometry> odometry;
  std::vector<urban_nav_msgs::RelativePose> relative;
  std::vector<urban_nav_msgs::VoStatistics> frames;
  std::vector<sensor_msgs::PointCloud2> landmarks;
  std::vector<sensor_msgs::Image> tracks;
  std::vector<urban_nav_msgs::StageStatus> statuses;
  std::vector<tf2_msgs::TFMessage> transforms;

 private:
  bool connected_ = false;
};

}  // namespace swf_vo::test
