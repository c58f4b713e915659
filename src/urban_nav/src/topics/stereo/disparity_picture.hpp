// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "dense_stereo/near_scene.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav {

/// Returns disparities in colours (CV_8UC3, BGR) from far, blue, to near, red: the largest disparity of the image, or
/// `most` px if positive. Invalid pixels are black.
cv::Mat drawDisparities(const dense_stereo::DisparityImage& image, float most = 0.0F);

/// Returns standard deviations of disparities in colours (CV_8UC3, BGR) from 0, dark, to `most` px and above, bright.
/// Invalid pixels are black.
cv::Mat drawDeviations(const dense_stereo::DisparityImage& image, float most = 0.5F);

/// Returns the left image (CV_8UC3, BGR) with the points on the ground in green and obstacles in red.
cv::Mat drawGround(const dense_stereo::NearScene& scene, const urban_nav_core::ImageView& left,
                   const urban_nav_core::StereoCamera& camera);

}  // namespace urban_nav
