// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dense_stereo/disparity_image.hpp"
#include "urban_nav_core/camera/depth_samples.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/image/view.hpp"

namespace dense_stereo {

/// Returns the disparities of every second pixel of every second row, or of fewer, so that there are at most 60 000.
/// `left`: of the size of `image`.
urban_nav_core::DepthSamples sampleDepths(const DisparityImage& image, const urban_nav_core::ImageView& left,
                                          const urban_nav_core::StereoCamera& camera);

}  // namespace dense_stereo
