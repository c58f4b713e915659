// SPDX-License-Identifier: BSD-3-Clause
#include "session/bag_colour.hpp"

#include <sensor_msgs/CameraInfo.h>

#include <algorithm>
#include <utility>

#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/camera_info.hpp"

namespace urban_nav_input {

using urban_nav_core::CameraInfo;
using urban_nav_core::Pose;
using urban_nav_core::RawCamera;
using urban_nav_ros::RecordedImage;

namespace {

constexpr const char* kLeftWord = "left";

RecordedImage recordedImage(const RecordedMessage& message) {
  if (const auto raw = message.as<sensor_msgs::Image>()) return RecordedImage(sensor_msgs::ImageConstPtr(raw));
  if (const auto compressed = message.as<sensor_msgs::CompressedImage>())
    return RecordedImage(sensor_msgs::CompressedImageConstPtr(compressed));
  return {};
}

RecordedImage firstImage(Recording& recording, const std::string& topic) {
  if (const auto raw = recording.first<sensor_msgs::Image>(topic))
    return RecordedImage(sensor_msgs::ImageConstPtr(raw));
  if (const auto compressed = recording.first<sensor_msgs::CompressedImage>(topic))
    return RecordedImage(sensor_msgs::CompressedImageConstPtr(compressed));
  return {};
}

/// Returns the camera of raw or rectified images, and the pose of its optical frame in that of the raw images.
std::pair<RawCamera, Pose> readImageCamera(const CameraInfo& info, bool is_rectified, const std::string& where) {
  if (!is_rectified) return {rawCamera(withRawCamera(info), where), Pose()};
  RawCamera camera;
  camera.pinhole = rectifiedPinhole(info, where);
  return {camera, Pose(urban_nav_core::Quaterniond(info.R.transpose()), {0.0, 0.0, 0.0})};
}

}  // namespace

BagColour::BagColour(Recording& recording, const BagTopics& topics, const urban_nav_ros::StaticTransforms& transforms,
                     const std::optional<LeftCamera>& left) {
  for (std::size_t i = 0; i < kColourCameras; ++i) {
    const std::optional<ChosenTopic> topic = topics.find(colourRole(i)), info = topics.find(colourInfoRole(i));
    if (!topic) continue;
    const auto message = info ? recording.first<sensor_msgs::CameraInfo>(info->name) : nullptr;
    const std::string frame = firstImage(recording, topic->name).frame();
    addCamera(recording, colourRole(i), *topic,
              message ? std::optional(urban_nav_ros::toCameraInfo(*message)) : std::nullopt, info ? info->name : "",
              transforms.lookup(urban_nav_core::frames::kBaseLink, frame));
  }
  if (!left || !cameras_.empty() || !topics.panorama().empty()) return;
  const ChosenTopic topic = *topics.find(Role::Left);
  if (firstImage(recording, topic.name).hasColour())
    addCamera(recording, Role::Left, topic, left->calibration, topic.name, left->T_base_optical);
}

void BagColour::addCamera(Recording& recording, Role role, const ChosenTopic& topic,
                          const std::optional<CameraInfo>& info, const std::string& where,
                          const std::optional<Pose>& T_base_optical) {
  const auto leave = [&](const std::string& reason) {
    notes_.push_back(topic.name + " (" + toString(role) + ") does not colour the map: " + reason);
  };
  const RecordedImage first = firstImage(recording, topic.name);
  if (first.empty()) return leave("it has no image");
  if (!info) return leave(std::string("it has no camera_info (--topic ") + toString(role) + "_info:=NAME)");
  if (!T_base_optical) return leave("no static tf from base_link to \"" + first.frame() + "\"");
  if (!first.hasColour()) return leave("its images are grey");
  const urban_nav_ros::ColourImage image = first.colour();
  if (image.pixels.empty()) return leave(image.fault);
  try {
    const auto [camera, T_optical_image] = readImageCamera(*info, isRectifiedName(topic.name), where);
    if (camera.pinhole.width != image.pixels.cols || camera.pinhole.height != image.pixels.rows)
      return leave("its images have " + std::to_string(image.pixels.cols) + "x" + std::to_string(image.pixels.rows) +
                   " pixels, " + where + " is of " + std::to_string(camera.pinhole.width) + "x" +
                   std::to_string(camera.pinhole.height));
    cameras_.push_back({toString(role), topic.name, first.frame(), *T_base_optical * T_optical_image, camera});
  } catch (const urban_nav_core::UserError& error) {
    leave(error.what());
  }
}

std::vector<std::string> BagColour::topics() const {
  std::vector<std::string> names;
  for (const ColourCamera& camera : cameras_)
    if (camera.role != kLeftWord) names.push_back(camera.topic);
  return names;
}

bool BagColour::add(const RecordedMessage& message) {
  const auto camera = std::find_if(cameras_.begin(), cameras_.end(), [&](const ColourCamera& each) {
    return each.topic == message.topic() && each.role != kLeftWord;
  });
  if (camera == cameras_.end()) return false;
  addImage(static_cast<std::size_t>(camera - cameras_.begin()), recordedImage(message));
  return true;
}

void BagColour::addLeft(RecordedImage image) {
  const auto camera =
      std::find_if(cameras_.begin(), cameras_.end(), [](const ColourCamera& each) { return each.role == kLeftWord; });
  if (camera != cameras_.end()) addImage(static_cast<std::size_t>(camera - cameras_.begin()), std::move(image));
}

void BagColour::addImage(std::size_t camera, RecordedImage image) {
  if (!image.empty()) pending_.push_back({camera, image.stamp(), std::move(image)});
}

std::vector<ColourInput> BagColour::take() { return std::exchange(pending_, {}); }

void BagColour::archive(urban_nav_core::Archive& archive) {
  std::vector<ColourCamera> stored = cameras_;
  std::size_t count = stored.size();
  archive.count(count);
  if (archive.isReading()) stored.assign(count, {});
  for (ColourCamera& camera : stored) {
    urban_nav_core::Pinhole& pinhole = camera.camera.pinhole;
    auto k = camera.camera.distortion.coefficients();
    bool is_equidistant = camera.camera.distortion.isEquidistant();
    archive(camera.role, camera.topic, camera.frame, camera.T_base_camera, pinhole.fx, pinhole.fy, pinhole.cx,
            pinhole.cy, pinhole.width, pinhole.height, k, is_equidistant);
    if (!archive.isReading()) continue;
    camera.camera.distortion = is_equidistant ? urban_nav_core::Distortion::equidistant({k[0], k[1], k[2], k[3]})
                                              : urban_nav_core::Distortion(k);
  }
  if (archive.isReading() && cameras_.empty()) cameras_ = std::move(stored);
}

}  // namespace urban_nav_input
