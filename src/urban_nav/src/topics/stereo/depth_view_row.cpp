// SPDX-License-Identifier: BSD-3-Clause
#include "topics/stereo/depth_view_row.hpp"

#include <cmath>

namespace urban_nav {

using urban_nav_store::DepthView;

namespace {

constexpr int kLeastStep = 2;  // px; matching windows overlap, neighbouring pixels add little information
constexpr std::int64_t kMostSamples = 60'000;

int samplingStep(int width, int height) {
  int step = kLeastStep;
  while (static_cast<std::int64_t>(width / step) * (height / step) > kMostSamples) ++step;
  return step;
}

}  // namespace

DepthView depthViewRow(const dense_stereo::DisparityImage& image, const urban_nav_core::ImageView& left,
                       const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_base_camera) {
  DepthView row;
  row.step = samplingStep(image.width, image.height);
  row.fx = camera.left.fx;
  row.fy = camera.left.fy;
  row.cx = camera.left.cx;
  row.cy = camera.left.cy;
  row.baseline = camera.baseline;
  row.T_base_camera = T_base_camera;
  const int step = static_cast<int>(row.step);
  DepthView::Samples samples;
  samples.width = image.width / step;
  samples.height = image.height / step;
  for (int v = 0; v < samples.height; ++v)
    for (int u = 0; u < samples.width; ++u) {
      const std::size_t at = image.index(u * step, v * step);
      const float disparity = image.disparity[at] - static_cast<float>(camera.disparity_offset);
      const bool is_valid = image.isValid(u * step, v * step) && disparity > 0.0F;
      samples.disparity.push_back(is_valid ? disparity : 0.0F);
      samples.sigma.push_back(is_valid ? std::sqrt(image.variance[at]) : 0.0F);
      samples.grey.push_back(left.at(u * step, v * step));
    }
  row.packed = DepthView::pack(samples);
  return row;
}

}  // namespace urban_nav
