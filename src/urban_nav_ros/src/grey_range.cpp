// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/grey_range.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_ros/image.hpp"

namespace urban_nav_ros {
namespace {

constexpr int kSettlingImages = 40;   // first seconds of a pair
constexpr double kLowShare = 0.001;   // share of pixels below the range
constexpr double kHighShare = 0.999;  // one minus the share of pixels above the range
constexpr double kLevels = 256.0;
constexpr double kLeastLevels = 64.0;  // grey levels of a range that is displayed as by an 8-bit camera
constexpr double kBrighter = 2.0;      // relative to the upper end: then the range has changed permanently
constexpr int kSmall = 65536;          // pixels: smaller images are not subsampled
constexpr std::size_t kValues = 65536;

using Histogram = std::vector<std::uint32_t>;

void count(const cv::Mat& grey, Histogram& histogram) {
  const int stride = grey.rows * grey.cols > kSmall ? 2 : 1;
  for (int v = 0; v < grey.rows; v += stride) {
    const auto* row = grey.ptr<std::uint16_t>(v);
    for (int u = 0; u < grey.cols; u += stride) ++histogram[row[u]];
  }
}

/// Returns the smallest value that at least `share` of the pixels do not exceed.
double quantile(const Histogram& histogram, double share) {
  double all = 0.0, seen = 0.0;
  for (const std::uint32_t n : histogram) all += n;
  for (std::size_t value = 0; value < histogram.size(); ++value) {
    seen += histogram[value];
    if (seen > 0.0 && seen >= share * all) return static_cast<double>(value);
  }
  return 0.0;
}

GreyScale computeScale(const Histogram& histogram) {
  const double low = quantile(histogram, kLowShare), high = quantile(histogram, kHighShare);
  int bits = 8;
  while (bits < 16 && high >= std::ldexp(1.0, bits)) bits += 2;
  const double step = std::ldexp(1.0, bits - 8);
  if (high - low >= kLeastLevels * step || high <= low) return {0.0, step};
  return {low, (high - low + 1.0) / kLevels};
}

}  // namespace

void GreyRange::add(const sensor_msgs::Image& message) {
  if (isDeep(message)) add(toDeepGrey(message).pixels);
}

void GreyRange::add(const sensor_msgs::CompressedImage& message) {
  if (isDeep(message)) add(toDeepGrey(message).pixels);
}

void GreyRange::add(const cv::Mat& grey) {
  if (grey.type() != CV_16UC1) return;
  if (is_settled_) {
    Histogram alone(kValues);
    count(grey, alone);
    if (quantile(alone, kHighShare) >= kBrighter * (scale_.offset + kLevels * scale_.step))
      scale_ = computeScale(alone);
    return;
  }
  if (histogram_.empty()) histogram_.resize(kValues);
  count(grey, histogram_);
  scale_ = computeScale(histogram_);
  is_settled_ = ++images_ >= kSettlingImages;
}

void GreyRange::archive(urban_nav_core::Archive& archive) {
  archive(scale_.offset, scale_.step, is_settled_);
  archive.require(std::isfinite(scale_.offset) && scale_.step > 0.0 && std::isfinite(scale_.step),
                  "a grey scale is invalid");
  if (archive.isReading()) is_settled_ = true;
}

}  // namespace urban_nav_ros
