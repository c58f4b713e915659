// SPDX-License-Identifier: BSD-3-Clause
#include "live/tracks_picture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace swf_vo {

using urban_nav_core::Health;

namespace {

constexpr std::size_t kPathLength = 12;  // frames; longer paths hide the image
constexpr int kSubpixelBits = 4;         // fractional bits of OpenCV's drawing functions: 1/16 px

cv::Point fixedPoint(const cv::Point2f& pixel) {
  return {cvRound(pixel.x * (1 << kSubpixelBits)), cvRound(pixel.y * (1 << kSubpixelBits))};
}

cv::Scalar toColour(Health health) {
  switch (health) {
    case Health::Ok: return {90, 200, 90};
    case Health::Recovered: return {200, 200, 60};
    case Health::Degraded: return {30, 170, 255};
    case Health::Lost: return {60, 60, 240};
  }
  return {255, 255, 255};
}

}  // namespace

TracksPicture::TracksPicture(double near_disparity_px) : near_disparity_px_(near_disparity_px) {
  cv::Mat ramp(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::applyColorMap(ramp, colours_, cv::COLORMAP_TURBO);
}

void TracksPicture::follow(const Frame& frame) {
  for (const Feature& feature : frame.features) {
    Path& path = paths_[feature.landmark];
    if (frame.frame - path.last > 1) path.pixels.clear();
    path.last = frame.frame;
    if (path.pixels.size() == kPathLength) path.pixels.erase(path.pixels.begin());
    path.pixels.emplace_back(static_cast<float>(feature.pixel.x()), static_cast<float>(feature.pixel.y()));
  }
  for (auto it = paths_.begin(); it != paths_.end();)
    it = it->second.last == frame.frame ? std::next(it) : paths_.erase(it);
}

const cv::Mat& TracksPicture::draw(const urban_nav_core::ImageView& left, const Frame& frame) {
  follow(frame);
  picture_.release();
  if (left.empty()) return picture_;
  grey_.create(left.height, left.width, CV_8UC1);
  for (int v = 0; v < left.height; ++v) std::copy(left.row(v), left.row(v) + left.width, grey_.ptr(v));
  cv::cvtColor(grey_, picture_, cv::COLOR_GRAY2BGR);

  for (const Feature& feature : frame.features) {
    const double nearness =
        std::sqrt(std::clamp((feature.pixel.x() - feature.pixel.z()) / near_disparity_px_, 0.0, 1.0));
    const cv::Vec3b warm = colours_.at<cv::Vec3b>(0, cvRound(40.0 + 200.0 * nearness));
    const cv::Scalar colour = feature.trusted ? cv::Scalar(warm[0], warm[1], warm[2]) : cv::Scalar(150, 150, 150);
    const std::vector<cv::Point2f>& path = paths_.at(feature.landmark).pixels;
    for (std::size_t i = 1; i < path.size(); ++i)
      cv::line(picture_, fixedPoint(path[i - 1]), fixedPoint(path[i]), colour, 1, cv::LINE_AA, kSubpixelBits);
    const bool fresh = feature.age == 0;
    cv::circle(picture_, fixedPoint(path.back()), (fresh ? 3 : 2) << kSubpixelBits, colour, fresh ? 1 : cv::FILLED,
               cv::LINE_AA, kSubpixelBits);
  }
  cv::rectangle(picture_, {0, 0, picture_.cols, 4}, toColour(frame.status.health), cv::FILLED);
  if (!frame.status.sentence.empty())
    cv::putText(picture_, frame.status.sentence, {8, 22}, cv::FONT_HERSHEY_SIMPLEX, 0.45, toColour(frame.status.health),
                1, cv::LINE_AA);
  return picture_;
}

}  // namespace swf_vo
