// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/image/view.hpp"
#include "urban_nav_ros/image.hpp"

namespace urban_nav_input {

/// Returns the stored pixels of an image file (8 or 16 bits, one, three or four channels), or none and a fault that
/// names the file. A truncated file is a fault, since decoders would fill the rest with grey.
urban_nav_ros::GreyImage readPixels(const std::string& path);

/// Returns the common scale of the 16-bit pixels of image files, from the first of `paths`; skips missing or damaged
/// files.
urban_nav_ros::GreyScale sampleGreyScale(const std::vector<std::string>& paths);

/// Reads an image file as 8-bit grey values.
urban_nav_ros::GreyImage readGrey(const std::string& path, const urban_nav_ros::GreyScale& scale);

/// Returns a view of grey pixels and an owner that keeps them alive; both empty for no pixels.
std::pair<urban_nav_core::ImageView, std::shared_ptr<const void>> sharedView(const cv::Mat& grey);

/// Returns whether a name is that of an image file (png, jpg, jpeg, pgm, pnm, ppm, bmp, tif, tiff).
bool isImageName(const std::string& name);

}  // namespace urban_nav_input
