// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_ros/rectification_choice.hpp"
#include "urban_nav_ros/stereo_input.hpp"

namespace urban_nav_ros {

/// Whether the images of a live stereo camera are rectified already: what their name says, unless the first pairs
/// clearly show otherwise. One calibration; reset() begins the next. Used by one thread.
class RectificationJudge {
 public:
  /// `as_named`: what the topic's name says. `by_images`: pairs are looked at; else `as_named` is the answer.
  /// `sync_tolerance`: s, between the stamps of a pair.
  RectificationJudge(bool as_named, bool by_images, double sync_tolerance = 0.005);

  /// Takes an image into account while there is no answer.
  void add(const ImageInput& image);
  /// Returns the answer, which then stays; nothing where more pairs are needed and `must_decide` is false. Never asks
  /// for more than 40 images. Throws UserError, as StereoCalibration.
  std::optional<bool> decide(const urban_nav_core::CameraInfo& left, const urban_nav_core::CameraInfo& right,
                             const std::string& where, bool must_decide);
  /// Returns a sentence for the operator where the answer contradicts the name; else nothing.
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
