// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dense_stereo/disparity_image.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav {

/// Checks the extension of a name for writeDisparity. Throws UserError naming `option` and the three extensions.
void checkDisparityName(const std::string& path, const std::string& option);

/// Writes disparities in the format of the extension of `path`: .pfm (px, NaN where invalid), .png (colours from far,
/// blue, to near, red; black where invalid) or .ply (points in the left optical frame, m, with the grey level of the
/// left image and the standard deviation along z). Throws UserError if the file cannot be written.
void writeDisparity(const std::string& path, const dense_stereo::DisparityImage& image,
                    const urban_nav_core::ImageView& left, const urban_nav_core::StereoCamera& camera);

/// Writes the variance of each disparity as PFM, px^2, NaN where invalid. Throws UserError if the file cannot be
/// written.
void writeVariance(const std::string& path, const dense_stereo::DisparityImage& image);

}  // namespace urban_nav
