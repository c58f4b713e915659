// SPDX-License-Identifier: BSD-3-Clause
#include "topics/vo/track_picture.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace urban_nav {

using swf_vo::Feature;
using urban_nav_core::ImageView;

namespace {

constexpr int kWidest = 900;  // px, in the report
constexpr int kJpegQuality = 78;
constexpr int kSubpixelBits = 4;  // of OpenCV's drawing coordinates

cv::Point fixedPoint(double u, double v, double scale) {
  const double unit = scale * (1 << kSubpixelBits);
  return {static_cast<int>(std::lround(u * unit)), static_cast<int>(std::lround(v * unit))};
}

/// Blue (far) over green and yellow to red (near), in BGR; `nearness` in 0...1.
cv::Scalar toColour(double nearness) {
  static const std::vector<cv::Scalar> stops = {
      {230, 120, 40}, {200, 200, 40}, {80, 210, 90}, {40, 200, 240}, {50, 70, 240}};
  const double at = std::clamp(nearness, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double share = at - static_cast<double>(i);
  return stops[i] * (1.0 - share) + stops[i + 1] * share;
}

}  // namespace

VoPicture drawTracks(const ImageView& image, const std::vector<std::vector<Feature>>& features) {
  VoPicture picture;
  auto* bytes = const_cast<std::uint8_t*>(image.data);  // cv::Mat has no const view; it is only read
  const cv::Mat grey(image.height, image.width, CV_8UC1, bytes, static_cast<std::size_t>(image.stride));
  const double scale = std::min(1.0, static_cast<double>(kWidest) / image.width);
  cv::Mat canvas;
  cv::resize(grey, canvas, {}, scale, scale, cv::INTER_AREA);
  cv::cvtColor(canvas, canvas, cv::COLOR_GRAY2BGR);

  std::map<swf_vo::LandmarkId, std::vector<cv::Point>> ways;
  for (const std::vector<Feature>& frame : features) {
    for (const Feature& feature : frame) {
      if (feature.pixel.x() > 0.0)
        ways[feature.landmark].push_back(fixedPoint(feature.pixel.x(), feature.pixel.y(), scale));
    }
  }
  if (!features.empty()) {
    for (const Feature& feature : features.back()) {
      if (!(feature.pixel.x() > 0.0)) continue;  // only in the right image
      const double disparity = feature.pixel.z() > 0.0 ? feature.pixel.x() - feature.pixel.z() : 1.0;
      const double nearness = std::log2(std::max(disparity, 1.0)) / 6.0;  // 1 px ... 64 px
      const cv::Scalar colour = feature.trusted ? toColour(nearness) : cv::Scalar(150, 150, 150);
      const std::vector<cv::Point>& way = ways[feature.landmark];
      for (std::size_t i = 1; i < way.size(); ++i)
        cv::line(canvas, way[i - 1], way[i], colour, 1, cv::LINE_AA, kSubpixelBits);
      cv::circle(canvas, way.back(), (feature.age == 0 ? 2 : 3) << kSubpixelBits, colour,
                 feature.age == 0 ? 1 : cv::FILLED, cv::LINE_AA, kSubpixelBits);
    }
  }
  picture.width = canvas.cols;
  picture.height = canvas.rows;
  cv::imencode(".jpg", canvas, picture.jpeg, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return picture;
}

}  // namespace urban_nav
