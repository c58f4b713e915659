// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/image_features.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace urban_nav_ros {

ImageFeatures extractFeatures(const urban_nav_core::ImageView& image) {
  constexpr int kMostFeatures = 1000;
  ImageFeatures features;
  if (image.empty()) return features;
  // The const_cast is safe: OpenCV only reads the pixels.
  const cv::Mat pixels(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),  // NOLINT
                       static_cast<std::size_t>(image.stride));
  cv::ORB::create(kMostFeatures, 1.2F, 1)
      ->detectAndCompute(pixels, cv::noArray(), features.points, features.descriptors);
  if (features.points.empty()) return features;
  std::vector<cv::Point2f> corners;
  cv::KeyPoint::convert(features.points, corners);
  cv::cornerSubPix(pixels, corners, {3, 3}, {-1, -1}, {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 10, 0.02});
  for (std::size_t i = 0; i < corners.size(); ++i) features.points[i].pt = corners[i];
  return features;
}

std::vector<cv::DMatch> matchFeatures(const ImageFeatures& left, const ImageFeatures& right) {
  std::vector<cv::DMatch> matches;
  if (left.points.empty() || right.points.empty()) return matches;
  cv::BFMatcher(cv::NORM_HAMMING, true).match(left.descriptors, right.descriptors, matches);
  constexpr float kMostBits = 40.0F;
  const auto far = [](const cv::DMatch& found) { return found.distance > kMostBits; };
  matches.erase(std::remove_if(matches.begin(), matches.end(), far), matches.end());
  return matches;
}

}  // namespace urban_nav_ros
