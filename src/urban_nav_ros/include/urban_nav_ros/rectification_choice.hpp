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

/// Pairs that a choice is made from.
constexpr int kJudgedPairs = 5;

/// How well the rows of matching points agree if images are taken as rectified already, and if they are rectified by
/// their calibration.
struct RectificationChoice {
  bool is_decided = false;                          ///< one interpretation is clearly better
  bool is_rectified = false;                        ///< the images are rectified already
  double as_they_are_px = 0.0, rectified_px = 0.0;  ///< median row error of each interpretation

  /// Returns whether the images are taken as rectified, `as_named` where nothing is decided.
  bool isRectified(bool as_named) const { return is_decided ? is_rectified : as_named; }
  /// Returns a sentence for the operator where what the images show contradicts what their name says; else nothing.
  std::string contradiction(bool as_named) const;
};

/// Judges pairs under both interpretations. `rectifying`: rectifies images by their calibration. Not decided with fewer
/// than three pairs, few matches, or rows that agree about equally well. Deterministic.
RectificationChoice chooseRectification(const std::vector<ImagePair>& pairs, const StereoCalibration& rectifying);

}  // namespace urban_nav_ros
