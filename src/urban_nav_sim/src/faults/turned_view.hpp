// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "camera/lens.hpp"

namespace urban_nav_sim {

/// The picture that a camera gives after it was turned about its centre, resampled from the one before: a turn moves
/// pixels whatever their distance. Pixels without a source repeat the border.
class TurnedView {
 public:
  TurnedView() = default;
  /// `turn`: takes directions in the axes of the turned camera to those before.
  TurnedView(const Lens& lens, const Eigen::AngleAxisd& turn);

  /// Requires an image of the size of the lens.
  cv::Mat apply(const cv::Mat& image) const;

 private:
  cv::Mat source_u_, source_v_;  // px, CV_32F
};

}  // namespace urban_nav_sim
