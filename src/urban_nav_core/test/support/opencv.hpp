// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "urban_nav_core/camera/distortion.hpp"
#include "urban_nav_core/camera/pinhole.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// The camera matrix as OpenCV takes it.
inline cv::Matx33d K(const Pinhole& p) { return {p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1}; }

/// The distortion coefficients as OpenCV takes them.
inline std::vector<double> D(const Distortion& d) { return {d.coefficients().begin(), d.coefficients().end()}; }

/// A view of the pixels of `image`, which must outlive it. Requires 8-bit grey.
inline ImageView view(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

}  // namespace urban_nav_core
