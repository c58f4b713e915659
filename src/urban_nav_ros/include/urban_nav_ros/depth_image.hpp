// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>
#include <string>

namespace urban_nav_ros {

/// Depths along the optical axis (CV_32FC1, m; 0: none), or no pixels and the reason.
struct DepthPixels {
  cv::Mat depth;
  std::string fault;
};

/// Decodes a depth image as defined by REP 118: 16UC1 or mono16 in mm, with 0 for none; 32FC1 in m, with NaN or an
/// infinity for none. Depths that are not positive are left out.
DepthPixels toDepth(const sensor_msgs::Image& message);
/// Decodes an image of compressed_depth_image_transport with a PNG: depths in mm, or inverse depths of a 32FC1 image.
/// A plain PNG of 16 bits is read as depths in mm.
DepthPixels toDepth(const sensor_msgs::CompressedImage& message);

}  // namespace urban_nav_ros
