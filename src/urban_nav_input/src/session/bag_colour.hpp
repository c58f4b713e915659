// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/source.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// The left camera of the stereo pair, as calibrated and mounted.
struct LeftCamera {
  urban_nav_core::CameraInfo calibration;
  urban_nav_core::Pose T_base_optical;  ///< of its raw images
};

/// The cameras of a recording that colour the map, other than a panoramic head, and their images. Not thread-safe.
class BagColour {
 public:
  BagColour() = default;
  /// Finds mounting and calibration of the cameras with images. One without transform or camera_info, or whose first
  /// image has no colour or another size, is not used; a note gives the reason. Without another camera or a panoramic
  /// head the left camera is used, if its images have colour.
  BagColour(Recording& recording, const BagTopics& topics, const urban_nav_ros::StaticTransforms& transforms,
            const std::optional<LeftCamera>& left);

  const std::vector<ColourCamera>& cameras() const { return cameras_; }
  const std::vector<std::string>& notes() const { return notes_; }
  /// Returns the topics to read that have no other role.
  std::vector<std::string> topics() const;
  /// Adds a message if it is an image of one of the cameras; returns whether it is.
  bool add(const RecordedMessage& message);
  /// Adds an image of the left camera, with its corrected stamp.
  void addLeft(urban_nav_ros::RecordedImage image);
  /// Returns the images since the last take().
  const std::vector<ColourInput>& pending() const { return pending_; }
  std::vector<ColourInput> take();

  /// Reads or writes the state between two messages, when all images were taken. Reading: cameras without extrinsics in
  /// these bags are those of the state.
  void archive(urban_nav_core::Archive& archive);

 private:
  void addCamera(Recording& recording, Role role, const ChosenTopic& topic,
                 const std::optional<urban_nav_core::CameraInfo>& info, const std::string& where,
                 const std::optional<urban_nav_core::Pose>& T_base_optical);
  void addImage(std::size_t camera, urban_nav_ros::RecordedImage image);

  std::vector<ColourCamera> cameras_;
  std::vector<ColourInput> pending_;
  std::vector<std::string> notes_;
};

}  // namespace urban_nav_input
