// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dense_stereo/disparity_image.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/image/view.hpp"
#include "urban_nav_store/tables/depth_view.hpp"

namespace urban_nav {

/// Returns the disparities of a keyframe thinned for the store, without session and stamp: every second pixel of every
/// second row, or fewer, so that a view has at most 60 000 samples. `left`: of the size of `image`.
urban_nav_store::DepthView depthViewRow(const dense_stereo::DisparityImage& image,
                                        const urban_nav_core::ImageView& left,
                                        const urban_nav_core::StereoCamera& camera,
                                        const urban_nav_core::Pose& T_base_camera);

}  // namespace urban_nav
