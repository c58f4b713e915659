// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_ros {

/// Corners at subpixel positions, distributed over the image, with ORB descriptors (Rublee et al. 2011).
struct ImageFeatures {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

/// Returns at most 1000 features. Deterministic.
ImageFeatures extractFeatures(const urban_nav_core::ImageView& image);

/// Returns mutual nearest neighbours whose descriptors differ by at most 40 bits, anywhere in the images: no constraint
/// on rows or disparities.
std::vector<cv::DMatch> matchFeatures(const ImageFeatures& left, const ImageFeatures& right);

}  // namespace urban_nav_ros
