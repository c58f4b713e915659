// SPDX-License-Identifier: BSD-3-Clause
#include "archive_image.hpp"

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "archive_message.hpp"

namespace urban_nav_ros {

namespace {

constexpr int kLargest = 1 << 14;  // px, of an image in PNG

/// Returns whether the message is a plane of bytes without gaps between its rows.
bool isPlane(const sensor_msgs::Image& image) {
  return image.width > 0 && image.height > 0 && image.width < kLargest && image.height < kLargest &&
         image.step == image.width && image.data.size() == static_cast<std::size_t>(image.step) * image.height;
}

/// Returns the message without its pixels.
sensor_msgs::ImageConstPtr copyHead(const sensor_msgs::Image& image) {
  auto head = boost::make_shared<sensor_msgs::Image>();
  head->header = image.header;
  head->height = image.height;
  head->width = image.width;
  head->encoding = image.encoding;
  head->is_bigendian = image.is_bigendian;
  head->step = image.step;
  return head;
}

std::vector<std::uint8_t> toPng(const sensor_msgs::Image& image) {
  const cv::Mat pixels(static_cast<int>(image.height), static_cast<int>(image.width), CV_8UC1,
                       const_cast<std::uint8_t*>(image.data.data()));
  std::vector<std::uint8_t> png;
  cv::imencode(".png", pixels, png, {cv::IMWRITE_PNG_COMPRESSION, 9});
  return png;
}

/// Returns the pixels; empty for damaged bytes.
cv::Mat fromPng(const std::vector<std::uint8_t>& png) {
  try {
    return png.empty() ? cv::Mat() : cv::imdecode(png, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {  // a size that is not allowed
    return {};
  }
}

}  // namespace

void archiveImage(urban_nav_core::Archive& archive, sensor_msgs::ImageConstPtr& message) {
  bool is_png = !archive.isReading() && isPlane(*message);
  archive(is_png);
  if (!is_png) return archiveMessage(archive, message);
  sensor_msgs::ImageConstPtr head = archive.isReading() ? nullptr : copyHead(*message);
  std::vector<std::uint8_t> png = archive.isReading() ? std::vector<std::uint8_t>() : toPng(*message);
  archiveMessage(archive, head);
  archive(png);
  if (!archive.isReading()) return;
  const cv::Mat pixels = fromPng(png);
  auto image = boost::make_shared<sensor_msgs::Image>(*head);
  image->data.assign(pixels.datastart, pixels.dataend);
  archive.require(pixels.type() == CV_8UC1 && pixels.isContinuous() && isPlane(*image), "an image is damaged");
  message = image;
}

}  // namespace urban_nav_ros
