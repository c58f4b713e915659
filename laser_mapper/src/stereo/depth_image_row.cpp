// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/depth_image_row.hpp"

namespace laser_mapper {

using urban_nav_store::DepthImage;
using urban_nav_store::DepthView;

namespace {

constexpr std::int64_t kMostDepthSamples = 60'000;  // of a stored image
constexpr float kLeastDeviation = 1.0F / 64.0F;     // px: valid; the map adds the error of the camera
constexpr std::uint8_t kNoIntensity = 128;          // depth images have no grey values

/// Returns every `step`-th depth of every `step`-th row as disparities.
DepthView::Samples sampleDepth(const cv::Mat& depth, int step) {
  DepthView::Samples samples;
  samples.width = depth.cols / step;
  samples.height = depth.rows / step;
  for (int v = 0; v < samples.height; ++v)
    for (int u = 0; u < samples.width; ++u) {
      const float z = depth.at<float>(v * step, u * step);
      samples.disparity.push_back(z > 0.0F ? static_cast<float>(DepthImage::kFocalBaseline) / z : 0.0F);
      samples.sigma.push_back(z > 0.0F ? kLeastDeviation : 0.0F);
      samples.grey.push_back(kNoIntensity);
    }
  return samples;
}

}  // namespace

DepthImage depthImageRow(const cv::Mat& depth, const urban_nav_core::Pinhole& pinhole) {
  DepthImage row;
  while (static_cast<std::int64_t>(depth.cols / row.step) * (depth.rows / row.step) > kMostDepthSamples) ++row.step;
  row.fx = pinhole.fx;
  row.fy = pinhole.fy;
  row.cx = pinhole.cx;
  row.cy = pinhole.cy;
  row.packed = DepthView::pack(sampleDepth(depth, static_cast<int>(row.step)));
  return row;
}

}  // namespace laser_mapper
