// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>
#include <string>

#include "urban_nav_core/image/view.hpp"
#include "urban_nav_ros/grey_range.hpp"

namespace urban_nav_ros {

/// Grey pixels (CV_8UC1), or none and a sentence that says why ("encoding yuv422: known are ..."): images of a robot
/// are data, and a bad one is no exception.
struct GreyImage {
  cv::Mat pixels;
  std::string fault;
};

/// Returns the grey values, in 8 or 16 bits as stored, of an image of any encoding of sensor_msgs/image_encodings.h
/// with 8 or 16 bits (mono, BGR, RGB, with alpha, Bayer, YUV 4:2:2; 8UC1, 8UC3, 8UC4, 16UC1, 16UC3, 16UC4 as mono, BGR,
/// BGRA); others are refused by name. One channel is not copied: the pixels then live as long as the message.
GreyImage toDeepGrey(const sensor_msgs::Image& message);
/// Decodes JPEG, PNG or whatever OpenCV reads; a Bayer mosaic that was compressed as one is demosaiced.
GreyImage toDeepGrey(const sensor_msgs::CompressedImage& message);
/// Converts decoded pixels; three and four channels are taken as BGR(A).
GreyImage toDeepGrey(const cv::Mat& pixels);

/// Returns grey values of 8 bits; 16-bit pixels by `scale`, which is one for all images of a pair of cameras, so that
/// brightness stays comparable (GreyRange).
GreyImage toGrey(const sensor_msgs::Image& message, const GreyScale& scale);
GreyImage toGrey(const sensor_msgs::CompressedImage& message, const GreyScale& scale);
GreyImage toGrey(const cv::Mat& pixels, const GreyScale& scale);
/// Returns grey values of 8 bits of an image by itself: 16-bit pixels by its own range.
GreyImage toGrey(const sensor_msgs::Image& message);
GreyImage toGrey(const sensor_msgs::CompressedImage& message);
GreyImage toGrey(const cv::Mat& pixels);

/// Returns the 8-bit colours (CV_8UC3, BGR) of a compressed image, 16-bit pixels by their own range; or a fault.
GreyImage toColour(const sensor_msgs::CompressedImage& message);
/// Returns the colours by one scale for several images.
GreyImage toColour(const sensor_msgs::CompressedImage& message, const GreyScale& scale);

/// Returns 16-bit pixels of any number of channels in 8 bits.
cv::Mat toEightBits(const cv::Mat& deep, const GreyScale& scale);

/// Returns whether an image may have 16-bit pixels, without decoding it.
bool isDeep(const sensor_msgs::Image& message);
bool isDeep(const sensor_msgs::CompressedImage& message);

/// Grey 8-bit pixels as mono8. The header is the caller's business.
sensor_msgs::Image toImageMessage(const cv::Mat& grey);
/// Converts 8-bit BGR pixels to a message of encoding bgr8. Sets no header.
sensor_msgs::Image toColourImageMessage(const cv::Mat& bgr);

/// Non-owning view of pixels of type CV_8UC1; empty for an empty matrix.
urban_nav_core::ImageView toView(const cv::Mat& grey);

}  // namespace urban_nav_ros
