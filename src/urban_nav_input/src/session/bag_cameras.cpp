// SPDX-License-Identifier: BSD-3-Clause
#include "session/bag_cameras.hpp"

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <vector>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/image.hpp"

namespace urban_nav_input {

using urban_nav_core::DataError;
using urban_nav_core::UserError;

namespace {

sensor_msgs::CameraInfoConstPtr findInfo(Recording& recording, const BagTopics& topics, Role role) {
  const std::optional<ChosenTopic> topic = topics.find(role);
  return topic ? recording.first<sensor_msgs::CameraInfo>(topic->name) : nullptr;
}

}  // namespace

FirstImage findFirstImage(Recording& recording, const ChosenTopic& topic) {
  if (topic.type == "sensor_msgs/Image") {
    const auto image = recording.first<sensor_msgs::Image>(topic.name);
    return image ? FirstImage{image->header.frame_id, static_cast<int>(image->width), static_cast<int>(image->height)}
                 : FirstImage{};
  }
  const auto image = recording.first<sensor_msgs::CompressedImage>(topic.name);
  if (!image) return {};
  const cv::Mat pixels = urban_nav_ros::toGrey(*image).pixels;
  return {image->header.frame_id, pixels.cols, pixels.rows};
}

std::string describeAssumedPlace(const std::string& camera_frame) {
  return "no static tf from base_link to \"" + camera_frame +
         "\": base_link is assumed at the left camera (REP-103 axes)";
}

CameraInfos readCameraInfos(Recording& recording, const BagTopics& topics, const std::string& name) {
  const auto left = findInfo(recording, topics, Role::LeftInfo), right = findInfo(recording, topics, Role::RightInfo);
  const std::vector<std::string> damage = recording.warnings();
  if ((!left || !right) && !damage.empty())
    throw DataError(name, "no camera_info can be read: " + damage.front(), "a recording that is not damaged");
  if (!left && !right)
    throw UserError(name, "has no camera_info for the left and the right images",
                    "--calibration FILE, or --topic left_info:=NAME --topic right_info:=NAME");
  if (!left || !right)
    throw UserError(
        name, std::string("has no camera_info for the ") + (left ? "right" : "left") + " images",
        std::string("--calibration FILE, or --topic ") + toString(left ? Role::RightInfo : Role::LeftInfo) + ":=NAME");
  return {urban_nav_ros::toCameraInfo(*left), urban_nav_ros::toCameraInfo(*right), left->header.frame_id};
}

}  // namespace urban_nav_input
