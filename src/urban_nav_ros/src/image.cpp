// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/image.hpp"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace urban_nav_ros {

namespace enc = sensor_msgs::image_encodings;
using urban_nav_core::ImageView;

namespace {

constexpr int kAsItIs = -1;  // one channel already

struct Layout {
  const char* encoding;
  int type;
  int to_grey;  // code of cv::cvtColor
};

const std::array<Layout, 26>& layouts() {
  // ROS names a Bayer pattern by its first row's first two pixels, OpenCV by the second row's second and third.
  static const std::array<Layout, 26> all = {{
      {"mono8", CV_8UC1, kAsItIs},
      {"8UC1", CV_8UC1, kAsItIs},
      {"mono16", CV_16UC1, kAsItIs},
      {"16UC1", CV_16UC1, kAsItIs},
      {"bgr8", CV_8UC3, cv::COLOR_BGR2GRAY},
      {"8UC3", CV_8UC3, cv::COLOR_BGR2GRAY},
      {"rgb8", CV_8UC3, cv::COLOR_RGB2GRAY},
      {"bgra8", CV_8UC4, cv::COLOR_BGRA2GRAY},
      {"8UC4", CV_8UC4, cv::COLOR_BGRA2GRAY},
      {"rgba8", CV_8UC4, cv::COLOR_RGBA2GRAY},
      {"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2GRAY},
      {"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2GRAY},
      {"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2GRAY},
      {"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2GRAY},
      {"bgr16", CV_16UC3, cv::COLOR_BGR2GRAY},
      {"16UC3", CV_16UC3, cv::COLOR_BGR2GRAY},
      {"rgb16", CV_16UC3, cv::COLOR_RGB2GRAY},
      {"bgra16", CV_16UC4, cv::COLOR_BGRA2GRAY},
      {"16UC4", CV_16UC4, cv::COLOR_BGRA2GRAY},
      {"rgba16", CV_16UC4, cv::COLOR_RGBA2GRAY},
      {"bayer_rggb16", CV_16UC1, cv::COLOR_BayerBG2GRAY},
      {"bayer_bggr16", CV_16UC1, cv::COLOR_BayerRG2GRAY},
      {"bayer_gbrg16", CV_16UC1, cv::COLOR_BayerGR2GRAY},
      {"bayer_grbg16", CV_16UC1, cv::COLOR_BayerGB2GRAY},
      {"yuv422", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY},
      {"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2GRAY_YUY2},
  }};
  return all;
}

const Layout* findLayout(const std::string& encoding) {
  const auto found =
      std::find_if(layouts().begin(), layouts().end(), [&](const Layout& l) { return encoding == l.encoding; });
  return found == layouts().end() ? nullptr : &*found;
}

std::string knownEncodings() {
  std::string names;
  for (const Layout& layout : layouts()) {
    names += (names.empty() ? "" : ", ") + std::string(layout.encoding);
  }
  return names;
}

/// The message's bytes as a matrix that shares them; empty with a fault if they are not what the header says.
GreyImage toPixels(const sensor_msgs::Image& message, const Layout*& layout) {
  layout = findLayout(message.encoding);
  if (layout == nullptr) return {{}, "encoding " + message.encoding + ": known are " + knownEncodings()};
  if (message.width == 0 || message.height == 0) return {{}, "no pixels"};
  if (message.width > 65535 || message.height > 65535) return {{}, "larger than 65535 pixels"};
  const std::size_t row = message.width * static_cast<std::size_t>(CV_ELEM_SIZE(layout->type));
  if (message.step < row)
    return {{}, "step " + std::to_string(message.step) + " is shorter than a row of " + std::to_string(row) + " bytes"};
  const std::size_t needed = static_cast<std::size_t>(message.step) * (message.height - 1) + row;
  if (message.data.size() < needed) {
    return {{}, std::to_string(message.data.size()) + " bytes where " + std::to_string(needed) + " are needed"};
  }
  auto* bytes = const_cast<std::uint8_t*>(message.data.data());  // cv::Mat has no const view; it is not written through
  cv::Mat shared(static_cast<int>(message.height), static_cast<int>(message.width), layout->type, bytes, message.step);
  if (CV_MAT_DEPTH(layout->type) == CV_16U && message.is_bigendian != 0) {
    cv::Mat swapped = shared.clone();
    for (int v = 0; v < swapped.rows; ++v) {
      auto* pixels = swapped.ptr<std::uint16_t>(v);
      for (int u = 0; u < swapped.cols * swapped.channels(); ++u)
        pixels[u] = static_cast<std::uint16_t>((pixels[u] << 8) | (pixels[u] >> 8));
    }
    return {swapped, {}};
  }
  return {shared, {}};
}

cv::Mat highestEight(const cv::Mat& deep, int bits) {
  const int shift = std::clamp(bits, 8, 16) - 8;
  cv::Mat grey(deep.size(), CV_8UC1);
  for (int v = 0; v < deep.rows; ++v) {
    const auto* from = deep.ptr<std::uint16_t>(v);
    auto* to = grey.ptr<std::uint8_t>(v);
    for (int u = 0; u < deep.cols; ++u) to[u] = static_cast<std::uint8_t>(std::min(from[u] >> shift, 255));
  }
  return grey;
}

int toBits(const cv::Mat& deep) {
  double highest = 0.0;
  cv::minMaxLoc(deep, nullptr, &highest);
  int bits = 8;
  while (bits < 16 && highest >= static_cast<double>(1 << bits)) bits += 2;
  return bits;
}

}  // namespace

GreyImage toGrey(const sensor_msgs::Image& message, int bits) {
  const Layout* layout = nullptr;
  GreyImage image = toPixels(message, layout);
  if (image.pixels.empty()) return image;
  cv::Mat grey;
  if (layout->to_grey == kAsItIs) grey = image.pixels;
  else cv::cvtColor(image.pixels, grey, layout->to_grey);  // never into the message's own bytes
  if (grey.depth() == CV_16U) return {highestEight(grey, bits), {}};
  return {grey, {}};
}

GreyImage toGrey(const sensor_msgs::CompressedImage& message, int bits) {
  if (message.data.empty()) return {{}, "no bytes"};
  try {
    const cv::Mat decoded = cv::imdecode(message.data, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR);
    if (decoded.empty())
      return {
          {},
          "format \"" + message.format + "\": " + std::to_string(message.data.size()) + " bytes that do not decode"};
    return toGrey(decoded, bits);
  } catch (const cv::Exception& error) {
    return {{}, "format \"" + message.format + "\": " + error.err};
  }
}

GreyImage toGrey(const cv::Mat& pixels, int bits) {
  if (pixels.empty()) return {{}, "no pixels"};
  cv::Mat grey = pixels;
  if (pixels.channels() == 3) {
    cv::cvtColor(pixels, grey, cv::COLOR_BGR2GRAY);
  } else if (pixels.channels() == 4) {
    cv::cvtColor(pixels, grey, cv::COLOR_BGRA2GRAY);
  } else if (pixels.channels() != 1) {
    return {{}, std::to_string(pixels.channels()) + " channels: 1, 3 or 4 are known"};
  }
  if (grey.depth() == CV_16U) return {highestEight(grey, bits), {}};
  if (grey.depth() != CV_8U) return {{}, "pixels are neither 8 nor 16 bits wide"};
  return {grey, {}};
}

int significantBits(const sensor_msgs::Image& message) {
  const Layout* layout = nullptr;
  const GreyImage image = toPixels(message, layout);
  return image.pixels.empty() ? 8 : significantBits(image.pixels);
}

int significantBits(const sensor_msgs::CompressedImage& message) {
  // PNG keeps the depth in its 25th byte; the usual 8 bits need no decoding.
  constexpr std::size_t kDepthAt = 24;
  const std::vector<std::uint8_t>& bytes = message.data;
  const bool png = bytes.size() > kDepthAt && bytes[0] == 0x89 && bytes[1] == 'P' && bytes[2] == 'N' && bytes[3] == 'G';
  if (!png || bytes[kDepthAt] != 16) return 8;
  try {
    return significantBits(cv::imdecode(bytes, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR));
  } catch (const cv::Exception&) {
    return 8;  // decoding says what is wrong
  }
}

int significantBits(const cv::Mat& pixels) {
  if (pixels.empty() || pixels.depth() != CV_16U) return 8;
  return toBits(pixels.channels() == 1 ? pixels : pixels.reshape(1));
}

sensor_msgs::Image toImageMessage(const cv::Mat& grey) {
  CV_Assert(grey.empty() || grey.type() == CV_8UC1);
  sensor_msgs::Image message;
  message.encoding = enc::MONO8;
  message.width = static_cast<std::uint32_t>(grey.cols);
  message.height = static_cast<std::uint32_t>(grey.rows);
  message.step = message.width;
  message.data.resize(static_cast<std::size_t>(grey.cols) * static_cast<std::size_t>(grey.rows));
  for (int v = 0; v < grey.rows; ++v)
    std::copy_n(grey.ptr(v), grey.cols, message.data.begin() + static_cast<std::ptrdiff_t>(v) * grey.cols);
  return message;
}

sensor_msgs::Image toColourImageMessage(const cv::Mat& bgr) {
  CV_Assert(bgr.empty() || bgr.type() == CV_8UC3);
  sensor_msgs::Image message;
  message.encoding = enc::BGR8;
  message.width = static_cast<std::uint32_t>(bgr.cols);
  message.height = static_cast<std::uint32_t>(bgr.rows);
  message.step = 3 * message.width;
  message.data.reserve(static_cast<std::size_t>(message.step) * message.height);
  for (int v = 0; v < bgr.rows; ++v)
    message.data.insert(message.data.end(), bgr.ptr(v), bgr.ptr(v) + static_cast<std::ptrdiff_t>(message.step));
  return message;
}

ImageView toView(const cv::Mat& grey) {
  if (grey.empty()) return {};
  CV_Assert(grey.type() == CV_8UC1);
  return {grey.data, grey.cols, grey.rows, static_cast<std::ptrdiff_t>(grey.step[0])};
}

}  // namespace urban_nav_ros
