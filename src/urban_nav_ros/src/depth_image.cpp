// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/depth_image.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace urban_nav_ros {

namespace {

constexpr float kMetresPerMillimetre = 0.001F;
constexpr const char* kSupported = "supported: 16UC1 and mono16 (mm), 32FC1 (m)";
constexpr const char* kCompressedDepth = "compressedDepth";
constexpr std::size_t kDepthHeaderBytes = 12;  // format, then the two parameters of inverse depths

float usableDepth(float depth) { return std::isfinite(depth) && depth > 0.0F ? depth : 0.0F; }

DepthPixels fromMillimetres(const cv::Mat& pixels) {
  DepthPixels result;
  pixels.convertTo(result.depth, CV_32F, static_cast<double>(kMetresPerMillimetre));
  return result;
}

/// Depths of a 32FC1 image are stored as a / z + b, and 0 where there is no measurement.
DepthPixels fromInverseDepths(const cv::Mat& pixels, float a, float b) {
  DepthPixels result;
  result.depth = cv::Mat(pixels.rows, pixels.cols, CV_32F);
  for (int v = 0; v < pixels.rows; ++v)
    for (int u = 0; u < pixels.cols; ++u) {
      const std::uint16_t stored = pixels.at<std::uint16_t>(v, u);
      result.depth.at<float>(v, u) = stored == 0 ? 0.0F : usableDepth(a / (static_cast<float>(stored) - b));
    }
  return result;
}

template <typename Value>
Value valueAt(const sensor_msgs::Image& message, int v, int u) {
  std::uint8_t raw[sizeof(Value)];
  const std::size_t at = static_cast<std::size_t>(v) * message.step + static_cast<std::size_t>(u) * sizeof(Value);
  for (std::size_t i = 0; i < sizeof raw; ++i)
    raw[message.is_bigendian != 0 ? sizeof raw - 1 - i : i] = message.data[at + i];
  Value value;
  std::memcpy(&value, raw, sizeof value);
  return value;
}

}  // namespace

DepthPixels toDepth(const sensor_msgs::Image& message) {
  const bool is_float = message.encoding == "32FC1";
  if (!is_float && message.encoding != "16UC1" && message.encoding != "mono16")
    return {{}, "encoding " + message.encoding + ": " + kSupported};
  const std::size_t row = static_cast<std::size_t>(message.width) * (is_float ? 4 : 2);
  if (message.width == 0 || message.height == 0 || message.step < row ||
      message.data.size() / message.step < message.height)
    return {{},
            std::to_string(message.data.size()) + " bytes are not " + std::to_string(message.height) +
                " rows of at least " + std::to_string(row) + " bytes"};
  DepthPixels result;
  result.depth = cv::Mat(static_cast<int>(message.height), static_cast<int>(message.width), CV_32F);
  for (int v = 0; v < result.depth.rows; ++v)
    for (int u = 0; u < result.depth.cols; ++u)
      result.depth.at<float>(v, u) =
          is_float ? usableDepth(valueAt<float>(message, v, u))
                   : kMetresPerMillimetre * static_cast<float>(valueAt<std::uint16_t>(message, v, u));
  return result;
}

DepthPixels toDepth(const sensor_msgs::CompressedImage& message) {
  const bool has_header = message.format.find(kCompressedDepth) != std::string::npos;
  if (has_header && message.data.size() <= kDepthHeaderBytes)
    return {{}, std::to_string(message.data.size()) + " bytes are no image of compressed_depth_image_transport"};
  const std::vector<std::uint8_t> png(
      message.data.begin() + static_cast<std::ptrdiff_t>(has_header ? kDepthHeaderBytes : 0), message.data.end());
  cv::Mat pixels;
  try {
    pixels = cv::imdecode(png, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {  // a damaged header
    pixels.release();
  }
  if (pixels.empty() || pixels.type() != CV_16UC1)
    return {{}, "format \"" + message.format + "\" holds no PNG with 16 bits; " + kSupported};
  if (!has_header || message.format.find("32FC1") == std::string::npos) return fromMillimetres(pixels);
  float a = 0.0F, b = 0.0F;
  std::memcpy(&a, message.data.data() + 4, sizeof a);
  std::memcpy(&b, message.data.data() + 8, sizeof b);
  return fromInverseDepths(pixels, a, b);
}

}  // namespace urban_nav_ros
