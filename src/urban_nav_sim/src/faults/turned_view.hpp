// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "camera/lens.hpp"

namespace urban_nav_sim {

/// Resamples an image for a camera rotated about its centre, which moves pixels independently of depth. Pixels without
/// a source repeat the border.
class TurnedView {
 public:
  TurnedView() = default;
  /// `turn`: rotation from the axes of the rotated camera to the original ones.
  TurnedView(const Lens& lens, const Eigen::AngleAxisd& turn);

  /// Requires an image of the size of the lens.
  cv::Mat apply(const cv::Mat& image) const;

 private:
  cv::Mat source_u_, source_v_;  // px, CV_32F
};

}  // namespace urban_nav_sim
