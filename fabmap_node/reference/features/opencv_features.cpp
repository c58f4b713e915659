// SPDX-License-Identifier: BSD-3-Clause
#include "reference/features/opencv_features.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <opencv2/core/version.hpp>
#include <opencv2/features2d.hpp>

#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

constexpr std::uint8_t kTrueTest = 45;

cv::Ptr<cv::Feature2D> makeDetector(OpenCvFeature feature, int wanted) {
  if (feature == OpenCvFeature::Orb) return cv::ORB::create(wanted);
#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 4)
  return cv::SIFT::create(wanted);
#else
  throw urban_nav_core::UserError("features", "sift, which OpenCV " CV_VERSION " does not have", "orb, or OpenCV 4.4");
#endif
}

ByteDescriptor toBytes(OpenCvFeature feature, const cv::Mat& descriptors, int row) {
  ByteDescriptor bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const int column = static_cast<int>(i);
    if (feature == OpenCvFeature::Orb)
      bytes[i] = (descriptors.at<std::uint8_t>(row, column / 8) >> (column % 8) & 1) != 0 ? kTrueTest : std::uint8_t{0};
    else bytes[i] = cv::saturate_cast<std::uint8_t>(descriptors.at<float>(row, column));
  }
  return bytes;
}

}  // namespace

PlaceObservation openCvObservation(OpenCvFeature feature, const urban_nav_core::ImageView& image, int wanted) {
  PlaceObservation observation;
  if (image.empty()) return observation;
  const cv::Mat pixels(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
                       static_cast<std::size_t>(image.stride));
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  makeDetector(feature, wanted)->detectAndCompute(pixels, cv::noArray(), points, descriptors);
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return points[static_cast<std::size_t>(a)].response > points[static_cast<std::size_t>(b)].response;
  });
  order.resize(std::min(order.size(), static_cast<std::size_t>(wanted)));  // equal responses may give a few more
  for (const int row : order) {
    const cv::Point2f& at = points[static_cast<std::size_t>(row)].pt;
    PlaceFeature found;
    found.descriptor = toBytes(feature, descriptors, row);
    found.u = std::clamp(at.x / static_cast<float>(image.width), 0.0F, 1.0F);
    found.v = std::clamp(at.y / static_cast<float>(image.height), 0.0F, 1.0F);
    observation.features.push_back(found);
  }
  return observation;
}

}  // namespace fabmap_node
