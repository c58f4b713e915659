// SPDX-License-Identifier: BSD-3-Clause
#include "session/bag_depth.hpp"

#include <sensor_msgs/CameraInfo.h>

#include <algorithm>
#include <utility>

#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/depth_image.hpp"
#include "urban_nav_ros/depth_inputs.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

using urban_nav_core::StampNs;

namespace {

DepthInput depthInput(const RecordedMessage& message) {
  DepthInput input;
  if (const auto raw = message.as<sensor_msgs::Image>()) {
    input.stamp = urban_nav_ros::toStampNs(raw->header.stamp);
    input.raw = raw;
  } else if (const auto compressed = message.as<sensor_msgs::CompressedImage>()) {
    input.stamp = urban_nav_ros::toStampNs(compressed->header.stamp);
    input.compressed = compressed;
  }
  return input;
}

/// Size and frame of the images of a depth camera, or the reason why they cannot be used.
struct FirstDepth {
  int width = 0, height = 0;
  std::string frame, fault;
};

FirstDepth findFirstDepth(Recording& recording, const std::string& topic) {
  urban_nav_ros::DepthPixels pixels;
  FirstDepth found;
  if (const auto raw = recording.first<sensor_msgs::Image>(topic)) {
    found.frame = raw->header.frame_id;
    pixels = urban_nav_ros::toDepth(*raw);
  } else if (const auto compressed = recording.first<sensor_msgs::CompressedImage>(topic)) {
    found.frame = compressed->header.frame_id;
    pixels = urban_nav_ros::toDepth(*compressed);
  } else {
    pixels.fault = "it has no image";
  }
  found.width = pixels.depth.cols;
  found.height = pixels.depth.rows;
  found.fault = std::move(pixels.fault);
  return found;
}

}  // namespace

BagDepth::BagDepth(Recording& recording, const BagTopics& topics, const urban_nav_ros::StaticTransforms& transforms) {
  for (std::size_t i = 0; i < kDepthCameras; ++i) {
    const std::optional<ChosenTopic> topic = topics.find(depthRole(i)), info = topics.find(depthInfoRole(i));
    if (!topic) continue;
    const auto leave = [&](const std::string& reason) {
      notes_.push_back(topic->name + " (" + toString(depthRole(i)) + ") is not used: " + reason);
    };
    const FirstDepth first = findFirstDepth(recording, topic->name);
    const auto message = info ? recording.first<sensor_msgs::CameraInfo>(info->name) : nullptr;
    const auto T_base_camera = transforms.lookup(urban_nav_core::frames::kBaseLink, first.frame);
    if (!first.fault.empty()) leave(first.fault);
    else if (!message) leave(std::string("it has no camera_info (--topic ") + toString(depthInfoRole(i)) + ":=NAME)");
    else if (!T_base_camera) leave("no static tf from base_link to \"" + first.frame + "\"");
    if (!first.fault.empty() || !message || !T_base_camera) continue;
    try {
      const urban_nav_ros::DepthCalibration calibration = urban_nav_ros::toDepthCalibration(*message, info->name);
      const urban_nav_core::Pinhole& pinhole = calibration.pinhole;
      if (pinhole.width != first.width || pinhole.height != first.height) {
        leave("its images have " + std::to_string(first.width) + "x" + std::to_string(first.height) + " pixels, " +
              info->name + " is of " + std::to_string(pinhole.width) + "x" + std::to_string(pinhole.height));
        continue;
      }
      if (calibration.is_distorted)
        notes_.push_back(topic->name + ": the distortion in " + info->name + " is not corrected in depth images");
      cameras_.push_back({toString(depthRole(i)), topic->name, first.frame, *T_base_camera, pinhole});
    } catch (const urban_nav_core::UserError& error) {
      leave(error.what());
    }
  }
}

bool BagDepth::add(const RecordedMessage& message) {
  const auto camera = std::find_if(cameras_.begin(), cameras_.end(),
                                   [&](const DepthCamera& each) { return each.topic == message.topic(); });
  if (camera == cameras_.end()) return false;
  DepthInput input = depthInput(message);
  input.camera = static_cast<std::size_t>(camera - cameras_.begin());
  if (input.raw || input.compressed) pending_.push_back(std::move(input));
  return true;
}

std::vector<DepthInput> BagDepth::take() { return std::exchange(pending_, {}); }

void BagDepth::archive(urban_nav_core::Archive& archive) {
  std::vector<DepthCamera> stored = cameras_;
  std::size_t count = stored.size();
  archive.count(count);
  if (archive.isReading()) stored.assign(count, {});
  for (DepthCamera& camera : stored)
    archive(camera.role, camera.topic, camera.frame, camera.T_base_camera, camera.pinhole.fx, camera.pinhole.fy,
            camera.pinhole.cx, camera.pinhole.cy, camera.pinhole.width, camera.pinhole.height);
  if (archive.isReading() && cameras_.empty()) cameras_ = std::move(stored);
}

}  // namespace urban_nav_input
