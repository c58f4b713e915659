// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <unordered_map>
#include <vector>

#include "swf_vo/frame.hpp"
#include "urban_nav_core/image/view.hpp"

namespace swf_vo {

/// Draws the tracked features into the left image: each with its path over the last frames, coloured by distance, new
/// ones as rings, untrusted ones in grey. For visualisation only.
class TracksPicture {
 public:
  /// `near_disparity_px`: shown in the warmest colour.
  explicit TracksPicture(double near_disparity_px);

  /// Requires consecutive frames for complete paths. The result (CV_8UC3, BGR) is valid until the next call; it is
  /// empty if there is no left image.
  const cv::Mat& draw(const urban_nav_core::ImageView& left, const Frame& frame);
  void clear() { paths_.clear(); }

 private:
  struct Path {
    FrameId last = 0;
    std::vector<cv::Point2f> pixels;  // oldest first
  };
  void follow(const Frame& frame);

  double near_disparity_px_;
  std::unordered_map<LandmarkId, Path> paths_;
  cv::Mat grey_, picture_, colours_;
};

}  // namespace swf_vo
