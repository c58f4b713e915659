// SPDX-License-Identifier: BSD-3-Clause
#include "dense_stereo/depth_samples.hpp"

#include <cmath>

namespace dense_stereo {

namespace {

constexpr int kLeastSampleStep = 2;  // px; matching windows overlap, neighbouring pixels add little information
constexpr std::int64_t kMostSamples = 60'000;

int samplingStep(int width, int height) {
  int step = kLeastSampleStep;
  while (static_cast<std::int64_t>(width / step) * (height / step) > kMostSamples) ++step;
  return step;
}

}  // namespace

urban_nav_core::DepthSamples sampleDepths(const DisparityImage& image, const urban_nav_core::ImageView& left,
                                          const urban_nav_core::StereoCamera& camera) {
  urban_nav_core::DepthSamples samples;
  samples.fx = camera.left.fx;
  samples.fy = camera.left.fy;
  samples.cx = camera.left.cx;
  samples.cy = camera.left.cy;
  samples.baseline = camera.baseline;
  const int step = samples.step = samplingStep(image.width, image.height);
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
  return samples;
}

}  // namespace dense_stereo
