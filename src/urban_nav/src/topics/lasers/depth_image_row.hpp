// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "urban_nav_input/session/source.hpp"
#include "urban_nav_store/tables/depth_image.hpp"

namespace urban_nav {

/// Returns depths (CV_32FC1, m; 0: none) as stored for the map, without session and stamp: subsampled to at most 60 000
/// samples.
urban_nav_store::DepthImage depthImageRow(const cv::Mat& depth, const urban_nav_input::DepthCamera& camera);

}  // namespace urban_nav
