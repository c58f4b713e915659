// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav_ros {

/// Map from 16-bit pixels to 8-bit grey values: (pixel - offset) / step, rounded down, within 0...255.
struct GreyScale {
  double offset = 0.0;
  double step = 256.0;
};

/// Identity for values up to 255: images whose pixels are class numbers.
constexpr GreyScale kPixelsAsStored = {0.0, 1.0};

/// Range of 16-bit grey values of a camera, or of several with equal brightness, determined from the first images, for
/// all inputs (recordings, folders, single pairs, live nodes). Cameras store 10, 12 or 14 bits in 16, and thermal ones
/// use a narrow range far from zero. The range is that of the quantiles 0.1 % and 99.9 %, which excludes hot pixels. If
/// it covers at least 64 of the 256 grey levels of the significant bits, the highest eight of those bits are used, as
/// in an 8-bit camera; otherwise the range is stretched. It is fixed after 40 images; later images reset it only if
/// they are twice as bright as its upper end. 8-bit images have no effect.
class GreyRange {
 public:
  /// Adds an image of any encoding that toDeepGrey() reads; damaged ones are skipped.
  void add(const sensor_msgs::Image& message);
  void add(const sensor_msgs::CompressedImage& message);
  /// `grey`: result of toDeepGrey().
  void add(const cv::Mat& grey);
  /// Fixes the range before the first image is converted.
  void settle() { is_settled_ = true; }
  bool isSettled() const { return is_settled_; }
  const GreyScale& scale() const { return scale_; }

  /// Reads or writes the scale and whether it is fixed; a range that was read is fixed.
  void archive(urban_nav_core::Archive& archive);

 private:
  std::vector<std::uint32_t> histogram_;  // one bin per value; empty before the first 16-bit image
  int images_ = 0;
  bool is_settled_ = false;
  GreyScale scale_;
};

}  // namespace urban_nav_ros
