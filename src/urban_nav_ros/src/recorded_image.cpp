// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/recorded_image.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "archive_message.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

struct ColourLayout {
  const char* encoding;
  int type;
  int to_bgr;  // conversion code of cv::cvtColor; kSameOrder: none
};

constexpr int kSameOrder = -1;

/// Encodings with colour. ROS names a Bayer pattern by the first two pixels of the first row, OpenCV by the second and
/// third pixel of the second row.
constexpr std::array<ColourLayout, 12> kColourLayouts = {{{"bgr8", CV_8UC3, kSameOrder},
                                                          {"8UC3", CV_8UC3, kSameOrder},
                                                          {"rgb8", CV_8UC3, cv::COLOR_RGB2BGR},
                                                          {"bgra8", CV_8UC4, cv::COLOR_BGRA2BGR},
                                                          {"8UC4", CV_8UC4, cv::COLOR_BGRA2BGR},
                                                          {"rgba8", CV_8UC4, cv::COLOR_RGBA2BGR},
                                                          {"yuv422", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
                                                          {"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2BGR_YUY2},
                                                          {"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2BGR},
                                                          {"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2BGR},
                                                          {"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2BGR},
                                                          {"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2BGR}}};

ColourImage fromGrey(const GreyImage& grey) {
  if (grey.pixels.empty()) return {{}, grey.fault};
  ColourImage colour;
  cv::cvtColor(grey.pixels, colour.pixels, cv::COLOR_GRAY2BGR);
  return colour;
}

template <typename Message>
GreyImage toGreyBy(const Message& message, const std::optional<GreyScale>& scale) {
  return scale ? toGrey(message, *scale) : toGrey(message);
}

ColourImage toColourImage(const sensor_msgs::Image& message, const std::optional<GreyScale>& scale) {
  const GreyImage grey = toGreyBy(message, scale);  // checks encoding and size
  if (grey.pixels.empty()) return {{}, grey.fault};
  for (const ColourLayout& layout : kColourLayouts) {
    if (message.encoding != layout.encoding) continue;
    auto* bytes = const_cast<std::uint8_t*>(message.data.data());  // cv::Mat has no const view; it is only read
    const cv::Mat shared(static_cast<int>(message.height), static_cast<int>(message.width), layout.type, bytes,
                         message.step);
    ColourImage colour;
    if (layout.to_bgr == kSameOrder) colour.pixels = shared.clone();
    else cv::cvtColor(shared, colour.pixels, layout.to_bgr);
    return colour;
  }
  return fromGrey(grey);
}

ColourImage toColourImage(const sensor_msgs::CompressedImage& message, const std::optional<GreyScale>& scale) {
  const GreyImage image = scale ? toColour(message, *scale) : toColour(message);
  return {image.pixels, image.fault};
}

}  // namespace

urban_nav_core::StampNs RecordedImage::stamp() const {
  if (raw_) return toStampNs(raw_->header.stamp);
  return compressed_ ? toStampNs(compressed_->header.stamp) : 0;
}

std::string RecordedImage::frame() const {
  if (raw_) return raw_->header.frame_id;
  return compressed_ ? compressed_->header.frame_id : std::string();
}

void RecordedImage::addTo(GreyRange& range) const {
  if (raw_) range.add(*raw_);
  if (compressed_) range.add(*compressed_);
}

GreyImage RecordedImage::grey() const {
  if (compressed_) return toGreyBy(*compressed_, scale_);
  if (!raw_) return {{}, "no image"};
  GreyImage grey = toGreyBy(*raw_, scale_);
  if (!grey.pixels.empty() && grey.pixels.data == raw_->data.data()) grey.pixels = grey.pixels.clone();
  return grey;
}

ColourImage RecordedImage::colour() const {
  if (compressed_) return toColourImage(*compressed_, scale_);
  if (!raw_) return {{}, "no image"};
  return toColourImage(*raw_, scale_);
}

bool RecordedImage::hasColour() const {
  if (raw_)
    return std::any_of(kColourLayouts.begin(), kColourLayouts.end(),
                       [&](const ColourLayout& layout) { return raw_->encoding == layout.encoding; });
  return compressed_ && urban_nav_ros::hasColour(*compressed_);
}

std::string RecordedImage::jpeg() const {
  if (compressed_ && compressed_->data.size() > 2 && compressed_->data[0] == 0xFF && compressed_->data[1] == 0xD8)
    return {compressed_->data.begin(), compressed_->data.end()};
  const ColourImage image = colour();
  if (image.pixels.empty()) return {};
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image.pixels, bytes, {cv::IMWRITE_JPEG_QUALITY, 92});
  return {bytes.begin(), bytes.end()};
}

void RecordedImage::archive(urban_nav_core::Archive& archive) {
  int kind = raw_ ? 1 : compressed_ ? 2 : 0;
  archive(kind);
  archive.require(kind >= 0 && kind <= 2, "a kind of image is unknown");
  if (archive.isReading()) *this = RecordedImage();
  if (kind == 1) archiveMessage(archive, raw_);
  if (kind == 2) archiveMessage(archive, compressed_);
  bool has_scale = scale_.has_value();
  GreyScale scale = scale_.value_or(GreyScale());
  archive(has_scale, scale.offset, scale.step);
  archive.require(scale.step > 0.0, "a grey scale is invalid");
  if (archive.isReading() && has_scale) scale_ = scale;
}

}  // namespace urban_nav_ros
