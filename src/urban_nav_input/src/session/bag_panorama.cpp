// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/bag_panorama.hpp"

#include <sensor_msgs/CameraInfo.h>

#include <algorithm>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/session/grey_survey.hpp"
#include "urban_nav_ros/camera_info.hpp"

namespace urban_nav_input {

using urban_nav_core::Archive;
using urban_nav_ros::Panorama;
using urban_nav_ros::PanoramaFeed;

namespace {

void archiveInfo(Archive& archive, urban_nav_core::CameraInfo& info) {
  archive(info.width, info.height, info.distortion_model, info.D, info.K, info.R, info.P);
}

void archiveCamera(Archive& archive, PanoramaCamera& camera) {
  archive(camera.number, camera.topic, camera.frame, camera.T_base_camera);
  bool is_calibrated = camera.calibration.has_value();
  archive(is_calibrated);
  if (archive.isReading() && is_calibrated) camera.calibration.emplace();
  if (is_calibrated) archiveInfo(archive, *camera.calibration);
}

}  // namespace

BagPanorama::BagPanorama(Recording& recording, const BagTopics& topics,
                         const urban_nav_ros::StaticTransforms& transforms) {
  for (const std::size_t number : topics.panorama()) {
    const ChosenTopic topic = *topics.find(panoramaRole(number));
    PanoramaCamera camera;
    camera.number = number;
    camera.topic = topic.name;
    if (const auto raw = recording.first<sensor_msgs::Image>(topic.name)) camera.frame = raw->header.frame_id;
    else if (const auto packed = recording.first<sensor_msgs::CompressedImage>(topic.name))
      camera.frame = packed->header.frame_id;
    else continue;
    camera.T_base_camera = transforms.lookup(urban_nav_core::frames::kBaseLink, camera.frame);
    if (const auto info = topics.find(panoramaInfoRole(number)))
      if (const auto message = recording.first<sensor_msgs::CameraInfo>(info->name))
        camera.calibration = urban_nav_ros::toCameraInfo(*message);
    cameras_.push_back(std::move(camera));
  }
  if (!cameras_.empty()) range_ = surveyGreyRange(recording, this->topics());
  begin();
}

void BagPanorama::begin() {
  feed_.reset();
  if (cameras_.empty()) return;
  PanoramaFeed::Options options;
  options.cameras = cameras_.size();
  feed_ = std::make_unique<PanoramaFeed>(options);
  feed_->expectRange(range_);
}

std::vector<std::string> BagPanorama::topics() const {
  std::vector<std::string> names;
  for (const PanoramaCamera& camera : cameras_) names.push_back(camera.topic);
  return names;
}

bool BagPanorama::add(const RecordedMessage& message) {
  const auto camera = std::find_if(cameras_.begin(), cameras_.end(),
                                   [&](const PanoramaCamera& c) { return c.topic == message.topic(); });
  if (camera == cameras_.end()) return false;
  const auto index = static_cast<std::size_t>(camera - cameras_.begin());
  if (const auto raw = message.as<sensor_msgs::Image>())
    feed_->add(index, urban_nav_ros::RecordedImage(sensor_msgs::ImageConstPtr(raw)));
  else if (const auto packed = message.as<sensor_msgs::CompressedImage>())
    feed_->add(index, urban_nav_ros::RecordedImage(sensor_msgs::CompressedImageConstPtr(packed)));
  return true;
}

void BagPanorama::finish() {
  if (feed_) feed_->finish();
}

std::vector<Panorama> BagPanorama::take() {
  std::vector<Panorama> panoramas;
  if (!feed_) return panoramas;
  while (auto panorama = feed_->take()) panoramas.push_back(std::move(*panorama));
  return panoramas;
}

std::vector<std::string> BagPanorama::faults() const {
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const std::string& topic = cameras_[i].topic;
    const urban_nav_core::TimeOrderedQueueCounts& counts = feed_->counts(i);
    if (counts.late > 0)
      faults.push_back(topic + ": " + std::to_string(counts.late) +
                       " images came too late by their stamps and were dropped");
    if (counts.duplicate > 0)
      faults.push_back(topic + ": " + std::to_string(counts.duplicate) +
                       " images have the stamp of another and were dropped");
    if (feed_->missing(i) > 0)
      faults.push_back(topic + ": " + std::to_string(feed_->missing(i)) + " of " + std::to_string(feed_->panoramas()) +
                       " panoramas have no image of this camera");
  }
  return faults;
}

void BagPanorama::archive(Archive& archive) {
  std::vector<PanoramaCamera> stored = cameras_;
  std::size_t count = stored.size();
  archive.count(count);
  if (archive.isReading()) stored.clear();
  for (std::size_t i = 0; i < count; ++i) {
    if (archive.isReading()) stored.emplace_back();
    archiveCamera(archive, stored[i]);
  }
  if (archive.isReading()) {
    for (const PanoramaCamera& camera : cameras_)
      archive.require(
          std::any_of(stored.begin(), stored.end(),
                      [&](const PanoramaCamera& c) { return c.topic == camera.topic && c.number == camera.number; }),
          "other panoramic cameras");
    cameras_ = std::move(stored);
    begin();
  }
  if (feed_) archive(*feed_);
}

}  // namespace urban_nav_input
