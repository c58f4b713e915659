// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>
#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/StageStatus.h>
#include <urban_nav_msgs/VoFrame.h>

#include <vector>

#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/listener.hpp"

namespace swf_vo::test {

/// A walk through a textured room, small enough to be rendered in a moment.
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

inline urban_nav_core::StereoCamera cameraOf(const urban_nav_core::testing::RenderCamera& rendered) {
  urban_nav_core::StereoCamera camera;
  camera.left = {rendered.fx, rendered.fy, rendered.cx, rendered.cy, rendered.width, rendered.height};
  camera.baseline = rendered.baseline;
  return camera;
}

/// The ROS graph as the nodelet sees it: a robot that publishes, and a listener who keeps everything.
class Graph : public urban_nav_ros::testing::Listener {
 public:
  Graph() : urban_nav_ros::testing::Listener("swf_vo") {
    keep("vo/odometry", odometry);
    keep("vo/relative_pose", relative);
    keep("vo/frame", frames);
    keep("vo/landmarks", landmarks);
    keep("vo/tracks", tracks);
    keep("swf_vo/status", statuses);
    keep("/tf", transforms);
    connected_ = until([this] { return isConnected(); });
  }
  bool connected() const { return connected_; }

  void place(const urban_nav_core::Pose& T_base_camera) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(
        urban_nav_ros::toStaticTransform("base_link", "stereo_left_optical_frame", T_base_camera));
    tf_static_.publish(message);
  }

  void publish(const urban_nav_core::testing::StereoFrame& frame, const urban_nav_core::StereoCamera& camera,
               bool left = true, bool right = true) {
    if (left) publish(left_, left_info_, frame.left, leftInfo(camera), frame.stamp, "stereo_left_optical_frame");
    if (right) publish(right_, right_info_, frame.right, rightInfo(camera), frame.stamp, "stereo_right_optical_frame");
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
  std::vector<urban_nav_msgs::VoFrame> frames;
  std::vector<sensor_msgs::PointCloud2> landmarks;
  std::vector<sensor_msgs::Image> tracks;
  std::vector<urban_nav_msgs::StageStatus> statuses;
  std::vector<tf2_msgs::TFMessage> transforms;

 private:
  static void publish(ros::Publisher& images, ros::Publisher& infos, const urban_nav_core::testing::GreyImage& image,
                      const urban_nav_core::CameraInfo& info, urban_nav_core::StampNs stamp, const std::string& frame) {
    auto pixels = image.pixels;
    sensor_msgs::Image message =
        urban_nav_ros::toImageMessage(cv::Mat(image.height, image.width, CV_8UC1, pixels.data()));
    sensor_msgs::CameraInfo calibration = urban_nav_ros::toCameraInfoMessage(info);
    message.header.stamp = calibration.header.stamp = urban_nav_ros::toRosTime(stamp);
    message.header.frame_id = calibration.header.frame_id = frame;
    infos.publish(calibration);
    images.publish(message);
  }

  ros::Publisher left_ = advertise<sensor_msgs::Image>("stereo/left/image_raw");
  ros::Publisher right_ = advertise<sensor_msgs::Image>("stereo/right/image_raw");
  ros::Publisher left_info_ = advertise<sensor_msgs::CameraInfo>("stereo/left/camera_info");
  ros::Publisher right_info_ = advertise<sensor_msgs::CameraInfo>("stereo/right/camera_info");
  ros::Publisher tf_static_ = advertise<tf2_msgs::TFMessage>("/tf_static", true);
  bool connected_ = false;
};

}  // namespace swf_vo::test
