// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/source.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// The panoramic head of a recording: its cameras, and its images grouped into panoramas. Not thread-safe.
class BagPanorama {
 public:
  BagPanorama() = default;
  /// Reads frame, extrinsics and calibration of the cameras with a topic of `topics` that has images. Throws
  /// DataError for a damaged recording.
  BagPanorama(Recording& recording, const BagTopics& topics, const urban_nav_ros::StaticTransforms& transforms);

  const std::vector<PanoramaCamera>& cameras() const { return cameras_; }
  /// Returns the topics to read.
  std::vector<std::string> topics() const;
  /// Adds a message if it is an image of one of the cameras; returns whether it is.
  bool add(const RecordedMessage& message);
  void finish();
  /// Returns all panoramas that are complete, or cannot be completed any more.
  std::vector<urban_nav_ros::Panorama> take();
  /// Returns sentences on images that are missing, late, or duplicates.
  std::vector<std::string> faults() const;

  /// Reads or writes the state between two messages. Reading: cameras without extrinsics in these bags get those of the
  /// state. Throws DataError if the bags have other cameras.
  void archive(urban_nav_core::Archive& archive);

 private:
  void begin();

  std::vector<PanoramaCamera> cameras_;
  urban_nav_ros::GreyRange range_;
  std::unique_ptr<urban_nav_ros::PanoramaFeed> feed_;  // null without cameras
};

}  // namespace urban_nav_input
