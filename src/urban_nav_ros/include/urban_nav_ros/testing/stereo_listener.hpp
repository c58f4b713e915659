// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_msgs/TFMessage.h>

#include <string>
#include <utility>

#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/listener.hpp"
#include "urban_nav_ros/testing/receipts.hpp"

namespace urban_nav_ros::testing {

/// Listener that also simulates the robot's stereo camera: its four topics, and its mounting on /tf_static. Waits until
/// the node has received each message: images of one side do not overtake those of the other.
class StereoListener : public Listener {
 public:
  /// `node`: the nodelet's name, under which its services are.
  explicit StereoListener(const std::string& node) : Listener(node), receipts_(node) {}

  /// Publishes the pose of the left optical frame in kBaseLink.
  void place(const urban_nav_core::Pose& T_base_left) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(
        toStaticTransform(urban_nav_core::frames::kBaseLink, urban_nav_core::frames::kStereoLeft, T_base_left));
    EXPECT_TRUE(receipts_.await({{"/tf_static", 1}}, [&] { tf_static_.publish(message); })) << "/tf_static";
  }

  /// Publishes a pair, or one side of it, with its camera_info. `stamp`: replaces that of the frame.
  void show(const urban_nav_core::testing::StereoFrame& frame, const urban_nav_core::StereoCamera& camera,
            urban_nav_core::StampNs stamp, bool left = true, bool right = true) {
    Receipts::Messages messages;
    for (const char* topic : {"stereo/left/image_raw", "stereo/left/camera_info"}) messages[topic] = left ? 1 : 0;
    for (const char* topic : {"stereo/right/image_raw", "stereo/right/camera_info"}) messages[topic] = right ? 1 : 0;
    EXPECT_TRUE(receipts_.await(messages, [&] {
      if (left) publish(left_, left_info_, frame.left, leftInfo(camera), stamp, urban_nav_core::frames::kStereoLeft);
      if (right)
        publish(right_, right_info_, frame.right, rightInfo(camera), stamp, urban_nav_core::frames::kStereoRight);
    })) << "images at "
        << stamp;
  }

  /// Returns the counter of messages that the nodelet has received.
  const Receipts& receipts() const { return receipts_; }

 private:
  static void publish(ros::Publisher& images, ros::Publisher& infos, const urban_nav_core::testing::GreyImage& image,
                      const urban_nav_core::CameraInfo& info, urban_nav_core::StampNs stamp, const std::string& frame) {
    auto pixels = image.pixels;
    sensor_msgs::Image message = toImageMessage(cv::Mat(image.height, image.width, CV_8UC1, pixels.data()));
    sensor_msgs::CameraInfo calibration = toCameraInfoMessage(info);
    message.header.stamp = calibration.header.stamp = toRosTime(stamp);
    message.header.frame_id = calibration.header.frame_id = frame;
    infos.publish(calibration);
    images.publish(message);
  }

  const Receipts receipts_;
  ros::Publisher left_ = advertise<sensor_msgs::Image>("stereo/left/image_raw");
  ros::Publisher right_ = advertise<sensor_msgs::Image>("stereo/right/image_raw");
  ros::Publisher left_info_ = advertise<sensor_msgs::CameraInfo>("stereo/left/camera_info");
  ros::Publisher right_info_ = advertise<sensor_msgs::CameraInfo>("stereo/right/camera_info");
  ros::Publisher tf_static_ = advertise<tf2_msgs::TFMessage>("/tf_static", true);
};

}  // namespace urban_nav_ros::testing
