// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/source.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// The depth cameras of a recording and their images. Not thread-safe.
class BagDepth {
 public:
  BagDepth() = default;
  /// Finds mounting and calibration of the cameras with images. One without transform or camera_info, or whose images
  /// cannot be decoded, is not used, and a note gives the reason.
  BagDepth(Recording& recording, const BagTopics& topics, const urban_nav_ros::StaticTransforms& transforms);

  const std::vector<DepthCamera>& cameras() const { return cameras_; }
  const std::vector<std::string>& notes() const { return notes_; }
  /// Adds a message if it is an image of one of the cameras; returns whether it is.
  bool add(const RecordedMessage& message);
  /// Returns the images since the last take().
  const std::vector<DepthInput>& pending() const { return pending_; }
  std::vector<DepthInput> take();

  /// Reads or writes the state between two messages, when all images were taken. Reading: cameras without extrinsics in
  /// these bags are those of the state.
  void archive(urban_nav_core::Archive& archive);

 private:
  std::vector<DepthCamera> cameras_;
  std::vector<DepthInput> pending_;
  std::vector<std::string> notes_;
};

}  // namespace urban_nav_input
