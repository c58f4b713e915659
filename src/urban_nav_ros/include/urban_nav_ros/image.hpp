// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>
#include <string>

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_ros {

/// Grey pixels (CV_8UC1), or none and a sentence that says why ("encoding yuv422: known are ..."): images of a robot
/// are data, and a bad one is no exception.
struct GreyImage {
  cv::Mat pixels;
  std::string fault;
};

/// Returns the grey values of an image of any encoding of sensor_msgs/image_encodings.h with 8 or 16 bits (mono, BGR,
/// RGB, with alpha, Bayer, YUV 4:2:2; 8UC1, 8UC3, 8UC4, 16UC1, 16UC3, 16UC4 as mono, BGR, BGRA); others are refused by
/// name. mono8 is not copied: the pixels then live as long as the message. `bits` is the depth of 16-bit pixels
/// (8...16, from significantBits): the highest eight of them are kept, the same for all images of a pair of cameras so
/// that brightness stays comparable.
GreyImage toGrey(const sensor_msgs::Image& message, int bits = 16);
/// JPEG, PNG or whatever OpenCV reads.
GreyImage toGrey(const sensor_msgs::CompressedImage& message, int bits = 16);
/// The same for decoded pixels; three and four channels are taken as BGR(A).
GreyImage toGrey(const cv::Mat& pixels, int bits = 16);

/// How many low bits of a 16-bit image are in use, rounded up to 8, 10, 12, 14 or 16 (cameras put 10 or 12 bits into
/// 16). 8 for other images.
int significantBits(const sensor_msgs::Image& message);
int significantBits(const sensor_msgs::CompressedImage& message);
int significantBits(const cv::Mat& pixels);

/// Grey 8-bit pixels as mono8. The header is the caller's business.
sensor_msgs::Image toImageMessage(const cv::Mat& grey);
/// Converts 8-bit BGR pixels to a message of encoding bgr8. Sets no header.
sensor_msgs::Image toColourImageMessage(const cv::Mat& bgr);

/// Non-owning view of pixels of type CV_8UC1; empty for an empty matrix.
urban_nav_core::ImageView toView(const cv::Mat& grey);

}  // namespace urban_nav_ros
