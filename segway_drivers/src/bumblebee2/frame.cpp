// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/bumblebee2/frame.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "segway_drivers/camera/bus_time.hpp"

namespace segway_drivers {

namespace {

constexpr int kEmbeddedPixels = 8;  // of each imager under 16 raw bytes

void readBb2Words(const std::uint8_t* words, Bb2Frame& frame) {
  frame.bus_time = parseBusTime(bigWord32(words));
  frame.gain = static_cast<std::uint16_t>(bigWord32(words + 4) & 0xFFFU);
  frame.shutter = static_cast<std::uint16_t>(bigWord32(words + 8) & 0xFFFU);
  frame.sequence = bigWord32(words + 12);
}

void replaceBb2Words(cv::Mat& image, int pixels) {
  image(cv::Rect(0, 2, pixels, 1)).copyTo(image(cv::Rect(0, 0, pixels, 1)));
}

}  // namespace

Bb2Frame splitBb2Frame(ByteView raw, bool swap, Bb2Embedding embedding) {
  Bb2Frame frame;
  const cv::Mat both(kBb2Height, kBb2Width, CV_8UC2, const_cast<std::uint8_t*>(raw.data));
  std::array<cv::Mat, 2> imagers;
  cv::split(both, imagers.data());
  frame.right = imagers[swap ? 1 : 0];
  frame.left = imagers[swap ? 0 : 1];
  readBb2Words(embedding == Bb2Embedding::Raw ? raw.data : frame.left.data, frame);
  const int pixels = embedding == Bb2Embedding::Raw ? kEmbeddedPixels : 2 * kEmbeddedPixels;
  replaceBb2Words(frame.left, pixels);
  replaceBb2Words(frame.right, pixels);
  return frame;
}

FrameProbe probeBb2Frame(ByteView bytes) {
  if (bytes.size < kBb2FrameSize) return {FrameProbe::Kind::Incomplete, kBb2FrameSize};
  return {FrameProbe::Kind::Frame, kBb2FrameSize};
}

std::optional<double> medianDisparity(const cv::Mat& left, const cv::Mat& right) {
  constexpr int kHalf = 7, kReach = 96;
  constexpr double kLeastCorrelation = 0.9;
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(left, corners, 200, 0.02, 12.0);
  std::vector<double> disparities;
  for (const cv::Point2f& corner : corners) {
    const cv::Rect patch(cvRound(corner.x) - kHalf, cvRound(corner.y) - kHalf, 2 * kHalf + 1, 2 * kHalf + 1);
    const cv::Rect strip = cv::Rect(patch.x - kReach, patch.y - 2, patch.width + 2 * kReach, patch.height + 4) &
                           cv::Rect(0, 0, right.cols, right.rows);
    if ((patch & cv::Rect(0, 0, left.cols, left.rows)) != patch || strip.height < patch.height ||
        strip.width < patch.width)
      continue;
    cv::Mat score;
    cv::matchTemplate(right(strip), left(patch), score, cv::TM_CCOEFF_NORMED);
    double best = 0.0;
    cv::Point at;
    cv::minMaxLoc(score, nullptr, &best, nullptr, &at);
    if (best >= kLeastCorrelation) disparities.push_back(patch.x - (strip.x + at.x));
  }
  if (disparities.size() < 20) return std::nullopt;
  std::nth_element(disparities.begin(), disparities.begin() + static_cast<std::ptrdiff_t>(disparities.size() / 2),
                   disparities.end());
  return disparities[disparities.size() / 2];
}

}  // namespace segway_drivers
