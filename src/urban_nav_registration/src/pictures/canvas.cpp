// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/canvas.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "urban_nav_core/io/image_header.hpp"
#include "urban_nav_registration/io/jpeg.hpp"

namespace urban_nav_registration {

namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontScale = 0.42;

}  // namespace

void write(cv::Mat& canvas, const std::string& text, cv::Point at, const cv::Scalar& colour) {
  if (!text.empty()) cv::putText(canvas, text, at, kFont, kFontScale, colour, 1, cv::LINE_AA);
}

void writeTitle(cv::Mat& canvas, const std::string& title) {
  if (title.empty()) return;
  const cv::Size size = cv::getTextSize(title, kFont, kFontScale, 1, nullptr);
  cv::rectangle(canvas, {0, 0, size.width + 10, 18}, kInk, cv::FILLED);
  write(canvas, title, {5, 13}, kPaper);
}

Picture toPicture(const cv::Mat& canvas) {
  Picture result;
  result.width = canvas.cols;
  result.height = canvas.rows;
  result.bgr.assign(canvas.datastart, canvas.dataend);
  return result;
}

std::vector<std::uint8_t> encodeJpeg(const Picture& picture, int quality) {
  std::vector<std::uint8_t> bytes;
  if (picture.width <= 0 || picture.height <= 0 ||
      picture.bgr.size() != 3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height))
    return bytes;
  // cv::Mat has no const view; the pixels are only read
  const cv::Mat pixels(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.bgr.data()));
  cv::imencode(".jpg", pixels, bytes, {cv::IMWRITE_JPEG_QUALITY, std::clamp(quality, 1, 100)});
  return bytes;
}

Picture decodePicture(std::string_view jpeg) {
  const std::vector<std::uint8_t> bytes(jpeg.begin(), jpeg.end());
  if (!sizeOfJpeg(bytes) || !urban_nav_core::imageFault(jpeg).empty()) return {};
  try {
    const cv::Mat pixels = cv::imdecode(bytes, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    return pixels.empty() ? Picture() : toPicture(pixels);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace urban_nav_registration
