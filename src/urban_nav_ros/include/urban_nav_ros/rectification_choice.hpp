// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_ros/stereo_calibration.hpp"

namespace urban_nav_ros {

/// Left and right image of a pair, grey.
using ImagePair = std::pair<cv::Mat, cv::Mat>;

/// Number of pairs for a choice.
constexpr int kJudgedPairs = 5;

/// Row errors of matching points if the images are assumed rectified, and if they are rectified by their calibration.
struct RectificationChoice {
  bool is_decided = false;                          ///< one interpretation is clearly better
  bool is_rectified = false;                        ///< the images are rectified already
  double as_they_are_px = 0.0, rectified_px = 0.0;  ///< median row error of each interpretation

  /// Returns whether the images are rectified; `as_named` if undecided.
  bool isRectified(bool as_named) const { return is_decided ? is_rectified : as_named; }
  /// Returns a message if the images contradict the name of their topic; else an empty text.
  std::string contradiction(bool as_named) const;
};

/// Compares both interpretations on the pairs. `rectifying`: rectifies images by their calibration. Undecided with
/// fewer than three pairs, few matches, or similar row errors. Deterministic.
RectificationChoice chooseRectification(const std::vector<ImagePair>& pairs, const StereoCalibration& rectifying);

}  // namespace urban_nav_ros
