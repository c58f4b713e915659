// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav_ros {

/// The map from 16-bit pixels to grey values of 8 bits: (pixel - offset) / step, rounded down, within 0...255.
struct GreyScale {
  double offset = 0.0;
  double step = 256.0;
};

/// Pixels that are kept as they are, up to 255: images whose values are numbers of classes.
constexpr GreyScale kPixelsAsStored = {0.0, 1.0};

/// The range of 16-bit grey values of a camera, or of several with equal brightness, from their first images: the one
/// decision of every path (recordings, folders, single pairs, live nodes). Cameras put 10, 12 or 14 bits into 16, and
/// thermal ones use a narrow range far from zero; single hot pixels do not count, since the range is that of the
/// quantiles 0.1 % and 99.9 %. Where it covers 64 of the 256 grey levels that the significant bits give, the highest
/// eight of those bits are kept, as an 8-bit camera would; otherwise the range is stretched. It settles after 40
/// images; later ones reset it only if they are twice as bright as it can show. 8-bit images have no influence.
class GreyRange {
 public:
  /// Takes an image into account, of any kind that toDeepGrey() reads; damaged ones are passed over.
  void add(const sensor_msgs::Image& message);
  void add(const sensor_msgs::CompressedImage& message);
  /// `grey`: of toDeepGrey().
  void add(const cv::Mat& grey);
  /// Ends the collection: what follows are the images themselves.
  void settle() { is_settled_ = true; }
  bool isSettled() const { return is_settled_; }
  const GreyScale& scale() const { return scale_; }

  /// The scale and whether it is settled; a range that is read is settled.
  void archive(urban_nav_core::Archive& archive);

 private:
  std::vector<std::uint32_t> histogram_;  // one bin per value; empty before the first 16-bit image
  int images_ = 0;
  bool is_settled_ = false;
  GreyScale scale_;
};

}  // namespace urban_nav_ros
