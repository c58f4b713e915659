// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dense_stereo/disparity_image.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/image/view.hpp"
#include "urban_nav_store/tables/depth_view.hpp"

namespace urban_nav {

/// Returns the disparities of a keyframe as stored for the map (dense_stereo::sampleDepths()), without session and
/// stamp. `left`: of the size of `image`.
urban_nav_store::DepthView depthViewRow(const dense_stereo::DisparityImage& image,
                                        const urban_nav_core::ImageView& left,
                                        const urban_nav_core::StereoCamera& camera,
                                        const urban_nav_core::Pose& T_base_camera);

}  // namespace urban_nav
