// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_ros/rectification_choice.hpp"
#include "urban_nav_ros/stereo_input.hpp"

namespace urban_nav_ros {

/// Determines whether the images of a live stereo camera are rectified: by the topic's name, unless the first pairs
/// clearly contradict it. For one calibration; reset() starts the next. Used by one thread.
class RectificationJudge {
 public:
  /// `as_named`: according to the topic's name. `by_images`: evaluate pairs; otherwise `as_named` is returned.
  /// `sync_tolerance`: s, between the stamps of a pair.
  RectificationJudge(bool as_named, bool by_images, double sync_tolerance = 0.005);

  /// Adds an image while the decision is pending.
  void add(const ImageInput& image);
  /// Returns the decision, which is final; nullopt if more pairs are needed and `must_decide` is false. Needs at most
  /// 40 images. Throws UserError like StereoCalibration.
  std::optional<bool> decide(const urban_nav_core::CameraInfo& left, const urban_nav_core::CameraInfo& right,
                             const std::string& where, bool must_decide);
  /// Returns a message if the decision contradicts the topic's name; else an empty text.
  const std::string& contradiction() const { return contradiction_; }
  void reset();

 private:
  std::vector<ImagePair> decodePairs() const;

  const bool as_named_, by_images_;
  const urban_nav_core::StampNs sync_tolerance_;
  std::deque<ImageInput> seen_;
  std::optional<bool> answer_;
  std::string contradiction_;
};

}  // namespace urban_nav_ros
