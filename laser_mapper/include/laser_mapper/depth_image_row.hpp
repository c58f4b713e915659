// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "urban_nav_core/camera/pinhole.hpp"
#include "urban_nav_store/tables/depth_image.hpp"

namespace laser_mapper {

/// Returns depths (CV_32FC1, m along the optical axis; 0: none) as stored for the map, subsampled to at most 60 000
/// samples, without session, role, stamp, frame and mounting.
urban_nav_store::DepthImage depthImageRow(const cv::Mat& depth, const urban_nav_core::Pinhole& pinhole);

}  // namespace laser_mapper
