// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <unordered_map>
#include <vector>

#include "swf_vo/frame.hpp"
#include "urban_nav_core/image/view.hpp"

namespace swf_vo {

/// The left image with what the filter follows in it: each feature with the way it came over the last frames, coloured
/// by distance, new ones as rings, distrusted ones in grey. For people; nothing is computed from it.
class TracksPicture {
 public:
  /// `near_disparity_px`: shown in the warmest colour.
  explicit TracksPicture(double near_disparity_px);

  /// Frames must be handed in one after another for the ways to be complete. The result (CV_8UC3, BGR) lives until the
  /// next call; it is empty where there is no left image.
  const cv::Mat& draw(const urban_nav_core::ImageView& left, const Frame& frame);
  void clear() { ways_.clear(); }

 private:
  struct Way {
    FrameId last = 0;
    std::vector<cv::Point2f> pixels;  // oldest first
  };
  void follow(const Frame& frame);

  double near_disparity_px_;
  std::unordered_map<LandmarkId, Way> ways_;
  cv::Mat grey_, picture_, colours_;
};

}  // namespace swf_vo
