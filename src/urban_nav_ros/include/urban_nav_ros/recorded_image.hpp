// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_ros/grey_range.hpp"
#include "urban_nav_ros/image.hpp"

namespace urban_nav_ros {

/// Colour pixels (CV_8UC3, BGR), or none and the reason.
struct ColourImage {
  cv::Mat pixels;
  std::string fault;
};

/// Image as recorded or received, decoded on demand. Copies share the message, which is immutable. Const functions are
/// thread-safe.
class RecordedImage {
 public:
  RecordedImage() = default;
  explicit RecordedImage(sensor_msgs::ImageConstPtr image) : raw_(std::move(image)) {}
  explicit RecordedImage(sensor_msgs::CompressedImageConstPtr image) : compressed_(std::move(image)) {}

  /// Returns true if there is no message.
  bool empty() const { return !raw_ && !compressed_; }
  /// Return stamp (ns) and frame of the header; 0 and "" if there is no message.
  urban_nav_core::StampNs stamp() const;
  std::string frame() const;

  /// Returns the message of a compressed image; null for other images.
  const sensor_msgs::CompressedImageConstPtr& compressed() const { return compressed_; }

  /// Adds the image to a range of 16-bit pixels; no effect for other images.
  void addTo(GreyRange& range) const;
  /// Sets the scale of 16-bit pixels, common to all compared images; without it each image has its own.
  void setScale(const GreyScale& scale) { scale_ = scale; }

  /// Decodes to grey. The pixels remain valid after this object is destroyed.
  GreyImage grey() const;
  /// Decodes to colour; grey images have three equal channels.
  ColourImage colour() const;
  /// Returns whether the pixels have colour: by the encoding of a raw image, by the channels of a compressed one.
  bool hasColour() const;

  /// Returns the image as JPEG: the original bytes if it is one, otherwise encoded in colour with quality 92. Empty if
  /// it cannot be decoded.
  std::string jpeg() const;

  void archive(urban_nav_core::Archive& archive);

 private:
  sensor_msgs::ImageConstPtr raw_;  // at most one of them
  sensor_msgs::CompressedImageConstPtr compressed_;
  std::optional<GreyScale> scale_;
};

}  // namespace urban_nav_ros
