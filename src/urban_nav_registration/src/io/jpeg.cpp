// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/io/jpeg.hpp"

#include <opencv2/imgcodecs.hpp>

#include "urban_nav_core/io/image_header.hpp"

namespace urban_nav_registration {

std::optional<ImageSize> sizeOfJpeg(const std::vector<std::uint8_t>& bytes) {
  // ITU-T T.81, B.1 and B.2: segments of FF, a kind, a length that counts itself; the frame header is SOF0...SOF15
  // without DHT, JPG and DAC
  const auto number = [&bytes](std::size_t at) { return 256 * bytes[at] + bytes[at + 1]; };
  if (bytes.size() < 4 || number(0) != 0xFFD8) return std::nullopt;
  for (std::size_t at = 2; at + 9 <= bytes.size();) {
    if (bytes[at] != 0xFF) return std::nullopt;
    const std::uint8_t kind = bytes[at + 1];
    if (kind == 0xFF) {  // a fill byte
      ++at;
      continue;
    }
    if (kind >= 0xC0 && kind <= 0xCF && kind != 0xC4 && kind != 0xC8 && kind != 0xCC) {
      const ImageSize size{number(at + 7), number(at + 5)};
      if (size.width == 0 || size.height == 0) return std::nullopt;
      return size;
    }
    const int length = number(at + 2);
    if (length < 2) return std::nullopt;
    at += 2 + static_cast<std::size_t>(length);
  }
  return std::nullopt;
}

cv::Mat decodeJpeg(const std::vector<std::uint8_t>& bytes, ImageSize size) {
  const auto its = sizeOfJpeg(bytes);
  if (!its || its->width != size.width || its->height != size.height) return {};
  if (!urban_nav_core::imageFault(bytes.data(), bytes.size()).empty()) return {};
  try {
    cv::Mat pixels = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
    if (pixels.cols != size.width || pixels.rows != size.height) return {};
    return pixels;
  } catch (const cv::Exception&) {
    return {};
  }
}

std::vector<std::uint8_t> encodeJpeg(const urban_nav_core::ImageView& image, int quality) {
  // cv::Mat has no const view; the pixels are only read
  const cv::Mat pixels(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.data),
                       static_cast<std::size_t>(image.stride));
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", pixels, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return bytes;
}

}  // namespace urban_nav_registration
