// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>
#include <string>

#include "urban_nav_core/image/view.hpp"
#include "urban_nav_ros/grey_range.hpp"

namespace urban_nav_ros {

/// Grey pixels (CV_8UC1), or none and the reason ("encoding yuv422: supported: ..."). An invalid image is a result, not
/// an exception.
struct GreyImage {
  cv::Mat pixels;
  std::string fault;
};

/// Returns the grey values, in 8 or 16 bits as stored, of an image in an 8 or 16 bit encoding of
/// sensor_msgs/image_encodings.h (mono, BGR, RGB, with alpha, Bayer, YUV 4:2:2; 8UC1, 8UC3, 8UC4, 16UC1, 16UC3, 16UC4
/// as mono, BGR, BGRA); others are rejected by name. Single-channel pixels are not copied and are valid as long as the
/// message.
GreyImage toDeepGrey(const sensor_msgs::Image& message);
/// Decodes JPEG, PNG and all formats of OpenCV; compressed Bayer mosaics are demosaiced.
GreyImage toDeepGrey(const sensor_msgs::CompressedImage& message);
/// Converts decoded pixels; three and four channels are interpreted as BGR(A).
GreyImage toDeepGrey(const cv::Mat& pixels);

/// Returns 8-bit grey values; 16-bit pixels are converted by `scale`, which is common to both cameras of a pair so that
/// brightness is comparable (GreyRange).
GreyImage toGrey(const sensor_msgs::Image& message, const GreyScale& scale);
GreyImage toGrey(const sensor_msgs::CompressedImage& message, const GreyScale& scale);
GreyImage toGrey(const cv::Mat& pixels, const GreyScale& scale);
/// Returns 8-bit grey values; 16-bit pixels are converted by the image's own range.
GreyImage toGrey(const sensor_msgs::Image& message);
GreyImage toGrey(const sensor_msgs::CompressedImage& message);
GreyImage toGrey(const cv::Mat& pixels);

/// Returns 8-bit colours (CV_8UC3, BGR) of a compressed image, or a fault; 16-bit pixels by the image's own range.
GreyImage toColour(const sensor_msgs::CompressedImage& message);
/// Returns 8-bit colours by one scale for several images.
GreyImage toColour(const sensor_msgs::CompressedImage& message, const GreyScale& scale);

/// Returns whether a compressed image can be decoded and has three channels or a Bayer mosaic.
bool hasColour(const sensor_msgs::CompressedImage& message);

/// Converts 16-bit pixels of any number of channels to 8 bits.
cv::Mat toEightBits(const cv::Mat& deep, const GreyScale& scale);

/// Returns whether an image may have 16-bit pixels, without decoding it.
bool isDeep(const sensor_msgs::Image& message);
bool isDeep(const sensor_msgs::CompressedImage& message);

/// Converts 8-bit grey pixels to a mono8 message. Sets no header.
sensor_msgs::Image toImageMessage(const cv::Mat& grey);
/// Converts 8-bit BGR pixels to a message of encoding bgr8. Sets no header.
sensor_msgs::Image toColourImageMessage(const cv::Mat& bgr);

/// Non-owning view of pixels of type CV_8UC1; empty for an empty matrix.
urban_nav_core::ImageView toView(const cv::Mat& grey);

}  // namespace urban_nav_ros
