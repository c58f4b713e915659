// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/image.hpp"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "urban_nav_core/io/image_header.hpp"

namespace urban_nav_ros {

namespace enc = sensor_msgs::image_encodings;
using urban_nav_core::ImageView;

namespace {

constexpr int kAsItIs = -1;  // single channel

struct Layout {
  const char* encoding;
  int type;
  int to_grey;  // conversion code of cv::cvtColor
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

/// Returns the message's bytes as a matrix without a copy; empty with a fault if they contradict the header.
GreyImage toPixels(const sensor_msgs::Image& message, const Layout*& layout) {
  layout = findLayout(message.encoding);
  if (layout == nullptr) return {{}, "encoding " + message.encoding + ": supported: " + knownEncodings()};
  if (message.width == 0 || message.height == 0) return {{}, "no pixels"};
  if (message.width > 65535 || message.height > 65535) return {{}, "larger than 65535 pixels"};
  const std::size_t row = message.width * static_cast<std::size_t>(CV_ELEM_SIZE(layout->type));
  if (message.step < row)
    return {{}, "step " + std::to_string(message.step) + " is shorter than a row of " + std::to_string(row) + " bytes"};
  const std::size_t needed = static_cast<std::size_t>(message.step) * (message.height - 1) + row;
  if (message.data.size() < needed) {
    return {{}, std::to_string(message.data.size()) + " bytes, expected " + std::to_string(needed)};
  }
  auto* bytes = const_cast<std::uint8_t*>(message.data.data());  // cv::Mat has no const view; it is only read
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

constexpr std::size_t kPngDepthAt = 24;  // offset of the bit depth in a PNG

/// Returns the Bayer layout of compressed mosaics ("bayer_rggb8; png compressed"); nullptr for decoded images that
/// already have grey or colour ("bayer_rggb8; jpeg compressed bgr8").
const Layout* mosaicLayout(const std::string& format, const cv::Mat& decoded) {
  if (format.compare(0, 6, "bayer_") != 0 || decoded.channels() != 1) return nullptr;
  const std::size_t end = format.find_first_of("; ");
  const std::size_t compressed = format.find("compressed");
  const std::size_t target =
      compressed == std::string::npos ? compressed : format.find_first_not_of(' ', compressed + 10);
  if (target != std::string::npos && format.compare(target, 6, "bayer_") != 0) return nullptr;
  return findLayout(format.substr(0, end));
}

GreyImage decode(const sensor_msgs::CompressedImage& message) {
  if (message.data.empty()) return {{}, "no bytes"};
  const std::string fault = urban_nav_core::imageFault(message.data.data(), message.data.size());
  if (!fault.empty()) return {{}, "format \"" + message.format + "\": " + fault};
  try {
    cv::Mat decoded = cv::imdecode(message.data, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR);
    if (decoded.empty())
      return {{},
              "format \"" + message.format + "\": " + std::to_string(message.data.size()) + " bytes cannot be decoded"};
    return {decoded, {}};
  } catch (const cv::Exception& error) {
    return {{}, "format \"" + message.format + "\": " + error.err};
  }
}

/// Returns the scale of a single image.
GreyScale ownScale(const cv::Mat& grey) {
  GreyRange range;
  range.add(grey);
  return range.scale();
}

GreyImage withScale(GreyImage deep, const GreyScale& scale) {
  if (!deep.pixels.empty() && deep.pixels.depth() == CV_16U) deep.pixels = toEightBits(deep.pixels, scale);
  return deep;
}

GreyImage withOwnScale(GreyImage deep) {
  if (deep.pixels.empty() || deep.pixels.depth() != CV_16U) return deep;
  const GreyScale scale = ownScale(deep.pixels);
  return withScale(std::move(deep), scale);
}

}  // namespace

bool hasColour(const sensor_msgs::CompressedImage& message) {
  const cv::Mat decoded = decode(message).pixels;
  return decoded.channels() >= 3 || (!decoded.empty() && mosaicLayout(message.format, decoded) != nullptr);
}

cv::Mat toEightBits(const cv::Mat& deep, const GreyScale& scale) {
  CV_Assert(deep.depth() == CV_16U);
  std::vector<std::uint8_t> table(65536);
  for (std::size_t value = 0; value < table.size(); ++value)
    table[value] = static_cast<std::uint8_t>(
        std::clamp(std::floor((static_cast<double>(value) - scale.offset) / scale.step), 0.0, 255.0));
  cv::Mat grey(deep.size(), CV_MAKETYPE(CV_8U, deep.channels()));
  for (int v = 0; v < deep.rows; ++v) {
    const auto* from = deep.ptr<std::uint16_t>(v);
    auto* to = grey.ptr<std::uint8_t>(v);
    for (int u = 0; u < deep.cols * deep.channels(); ++u) to[u] = table[from[u]];
  }
  return grey;
}

GreyImage toDeepGrey(const sensor_msgs::Image& message) {
  const Layout* layout = nullptr;
  GreyImage image = toPixels(message, layout);
  if (image.pixels.empty() || layout->to_grey == kAsItIs) return image;
  cv::Mat grey;
  cv::cvtColor(image.pixels, grey, layout->to_grey);  // a new matrix, because the message must not be modified
  return {grey, {}};
}

GreyImage toDeepGrey(const sensor_msgs::CompressedImage& message) {
  const GreyImage image = decode(message);
  if (image.pixels.empty()) return image;
  const Layout* layout = mosaicLayout(message.format, image.pixels);
  if (layout == nullptr) return toDeepGrey(image.pixels);
  cv::Mat grey;
  cv::cvtColor(image.pixels, grey, layout->to_grey);
  return {grey, {}};
}

GreyImage toDeepGrey(const cv::Mat& pixels) {
  if (pixels.empty()) return {{}, "no pixels"};
  if (pixels.depth() != CV_8U && pixels.depth() != CV_16U) return {{}, "pixels are neither 8 nor 16 bits wide"};
  cv::Mat grey = pixels;
  if (pixels.channels() == 3) {
    cv::cvtColor(pixels, grey, cv::COLOR_BGR2GRAY);
  } else if (pixels.channels() == 4) {
    cv::cvtColor(pixels, grey, cv::COLOR_BGRA2GRAY);
  } else if (pixels.channels() != 1) {
    return {{}, std::to_string(pixels.channels()) + " channels: supported: 1, 3 or 4"};
  }
  return {grey, {}};
}

bool isDeep(const sensor_msgs::Image& message) {
  const Layout* layout = findLayout(message.encoding);
  return layout != nullptr && CV_MAT_DEPTH(layout->type) == CV_16U;
}

bool isDeep(const sensor_msgs::CompressedImage& message) {
  const std::vector<std::uint8_t>& bytes = message.data;
  if (bytes.size() <= kPngDepthAt) return false;
  if (bytes[0] == 0x89 && bytes[1] == 'P' && bytes[2] == 'N' && bytes[3] == 'G') return bytes[kPngDepthAt] == 16;
  return (bytes[0] == 'I' && bytes[1] == 'I') || (bytes[0] == 'M' && bytes[1] == 'M');  // possibly TIFF
}

GreyImage toGrey(const sensor_msgs::Image& message, const GreyScale& scale) {
  return withScale(toDeepGrey(message), scale);
}
GreyImage toGrey(const sensor_msgs::CompressedImage& message, const GreyScale& scale) {
  return withScale(toDeepGrey(message), scale);
}
GreyImage toGrey(const cv::Mat& pixels, const GreyScale& scale) { return withScale(toDeepGrey(pixels), scale); }

GreyImage toGrey(const sensor_msgs::Image& message) { return withOwnScale(toDeepGrey(message)); }
GreyImage toGrey(const sensor_msgs::CompressedImage& message) { return withOwnScale(toDeepGrey(message)); }
GreyImage toGrey(const cv::Mat& pixels) { return withOwnScale(toDeepGrey(pixels)); }

namespace {

/// Decodes to three channels at the stored bit depth.
GreyImage toDeepColour(const sensor_msgs::CompressedImage& message) {
  GreyImage image = decode(message);
  if (image.pixels.empty()) return image;
  if (const Layout* layout = mosaicLayout(message.format, image.pixels)) {
    // Conversion codes to colour and to grey have the same order: rggb, gbrg, bggr, grbg.
    cv::Mat colour;
    cv::cvtColor(image.pixels, colour, layout->to_grey - cv::COLOR_BayerBG2GRAY + cv::COLOR_BayerBG2BGR);
    image.pixels = colour;
  }
  if (image.pixels.channels() == 1) cv::cvtColor(image.pixels, image.pixels, cv::COLOR_GRAY2BGR);
  if (image.pixels.channels() == 4) cv::cvtColor(image.pixels, image.pixels, cv::COLOR_BGRA2BGR);
  return image;
}

}  // namespace

GreyImage toColour(const sensor_msgs::CompressedImage& message) {
  GreyImage image = toDeepColour(message);
  if (image.pixels.empty() || image.pixels.depth() != CV_16U) return image;
  const GreyScale scale = ownScale(toDeepGrey(image.pixels).pixels);
  return withScale(std::move(image), scale);
}

GreyImage toColour(const sensor_msgs::CompressedImage& message, const GreyScale& scale) {
  return withScale(toDeepColour(message), scale);
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
