// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <type_traits>

#include "urban_nav_live/stereo_input_parameters.hpp"
#include "urban_nav_ros/stage_node.hpp"
#include "urban_nav_ros/stereo_sessions.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_ros {

/// Returns the session options of a stage with these parameters.
inline StereoSessions::Options toStereoOptions(const urban_nav_live::StereoInputParameters& parameters,
                                               const ros::NodeHandle& nh) {
  StereoSessions::Options options;
  options.base_frame = parameters.base_frame;
  options.rectified = areRectified(parameters.image_type, nh.resolveName(topics::kLeftImage));
  options.judges_images = parameters.image_type == "auto";
  options.queue_size = parameters.queue_size;
  options.max_lateness = parameters.max_lateness;
  options.sync_tolerance = parameters.sync_tolerance;
  options.tf_timeout = parameters.tf_timeout;
  options.where = nh.resolveName("stereo");
  return options;
}

/// Subscribes to the images and camera_info of both sides as inputs of a stage. Requires that Input is constructible
/// from ImageInput and InfoInput. `options` apply to the images; camera_info is required only once.
template <typename Input>
void subscribeImages(StageNodeWith<Input>& node, const TopicOptions& options, bool compressed) {
  for (const Side side : {Side::Left, Side::Right}) {
    const bool is_left = side == Side::Left;
    TopicOptions once = options;
    once.timeout = urban_nav_live::TopicMonitor::kNoTimeout;
    once.queue = 10;
    node.template subscribeInput<sensor_msgs::CameraInfo>(is_left ? topics::kLeftInfo : topics::kRightInfo, once,
                                                          [side](const sensor_msgs::CameraInfoConstPtr& message) {
                                                            return Input(InfoInput{side, message});
                                                          });
    const char* images = is_left ? topics::kLeftImage : topics::kRightImage;
    const auto toInput = [side](const auto& message) {
      return Input(ImageInput{side, message, toStampNs(message->header.stamp)});
    };
    if (compressed) node.template subscribeInput<sensor_msgs::CompressedImage>(images, options, toInput);
    else node.template subscribeInput<sensor_msgs::Image>(images, options, toInput);
  }
  node.monitor().expectPairs(node.nh().resolveName(topics::kLeftImage), node.nh().resolveName(topics::kRightImage));
}

/// Subscribes to images, camera_info, /tf_static and motion sensors as inputs of a stage. Requires that Input is
/// constructible from ImageInput, InfoInput and tf2_msgs::TFMessageConstPtr, and from the messages of the motion
/// sensors, if any. `options` apply to images and motion; the absence of an optional sensor is not a fault.
template <typename Input>
void subscribeStereo(StageNodeWith<Input>& node, const TopicOptions& options, bool compressed,
                     const urban_nav_core::MotionChoice& motion) {
  const auto forward = [](const auto& message) { return Input(message); };
  TopicOptions unmonitored;
  unmonitored.is_monitored = unmonitored.is_paused = false;
  node.template subscribeInput<tf2_msgs::TFMessage>(topics::kStaticTransforms, unmonitored, forward);
  subscribeImages(node, options, compressed);
  TopicOptions moving = options;
  moving.is_monitored = motion.is_required;
  if constexpr (std::is_constructible_v<Input, nav_msgs::OdometryConstPtr>)
    if (motion.wheels) node.template subscribeInput<nav_msgs::Odometry>(topics::kWheelOdometry, moving, forward);
  if constexpr (std::is_constructible_v<Input, sensor_msgs::ImuConstPtr>)
    if (motion.gyroscope) node.template subscribeInput<sensor_msgs::Imu>(topics::kImu, moving, forward);
}

}  // namespace urban_nav_ros
