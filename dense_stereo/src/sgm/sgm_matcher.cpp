// SPDX-License-Identifier: BSD-3-Clause
#include "sgm/sgm_matcher.hpp"

#include <algorithm>
#include <cmath>

namespace dense_stereo {

namespace {

// Measured on rendered worlds and on Middlebury pairs, whose ground truth is accurate to 0.1 px (dense_stereo/bench,
// accuracy).
constexpr float kVarianceScale = 1.35F * 1.35F;  // neighbouring residuals are correlated
constexpr float kLeastSigma = 0.097F;            // px, errors not contained in the residuals

}  // namespace

void SgmMatcher::match(const MatcherInput& input, DisparityImage& image) {
  const int width = input.left.width(), height = input.left.height();
  const int disparities = (parameters_.disparities + 15) / 16 * 16;
  semi_global_.resize(width, height, disparities);
  semi_global_.match(input.left, input.right, Penalties{}, winners_);
  components_.remove(winners_.disparity, parameters_.min_component);
  depth_edges_.mark(winners_.disparity, edges_);
  start_.resize(width, height, DisparityField::kInvalid);
  for (int v = 0; v < height; ++v) {
    const std::uint16_t* from = winners_.disparity.row(v);
    float* to = start_.row(v);
    for (int u = 0; u < width; ++u)
      to[u] = from[u] == Winners::kInvalid ? DisparityField::kInvalid : static_cast<float>(from[u]);
  }
  const Exposure exposure = compareBrightness(input);
  alignment_.resize(width, height);
  alignment_.step(input.left, input.right, exposure, edges_, start_, field_);
  unsupported_.remove(input.left, winners_, field_);
  finish(image);
}

/// Estimated from matched pixels, by equal means and deviations.
Exposure SgmMatcher::compareBrightness(const MatcherInput& input) const {
  std::int64_t left = 0, right = 0, left_squares = 0, right_squares = 0, count = 0;
  for (int v = 0; v < input.left.height(); v += 2) {
    const std::uint8_t* l = input.left.row(v);
    const std::uint8_t* r = input.right.row(v);
    const std::uint16_t* d = winners_.disparity.row(v);
    for (int u = v / 2 % 4; u < input.left.width(); u += 4) {
      if (d[u] == Winners::kInvalid) continue;
      const int p = l[u], q = r[u - d[u]];
      left += p;
      right += q;
      left_squares += p * p;
      right_squares += q * q;
      ++count;
    }
  }
  if (count < 100) return {};
  const double n = static_cast<double>(count), mean_l = static_cast<double>(left) / n,
               mean_r = static_cast<double>(right) / n;
  const double variance_l = static_cast<double>(left_squares) / n - mean_l * mean_l;
  const double variance_r = static_cast<double>(right_squares) / n - mean_r * mean_r;
  if (variance_l < 1.0 || variance_r < 1.0) return {};
  const double gain = std::sqrt(variance_l / variance_r);
  return {static_cast<float>(gain), static_cast<float>(mean_l - gain * mean_r)};
}

void SgmMatcher::finish(DisparityImage& image) const {
  const auto largest = static_cast<float>(parameters_.max_sigma * parameters_.max_sigma);
  for (int v = 0; v < image.height; ++v) {
    const float* d = field_.disparity.row(v);
    const float* noise = field_.noise.row(v);
    const float* information = field_.information.row(v);
    for (int u = 0; u < image.width; ++u) {
      const std::size_t at = image.index(u, v);
      const float variance = kVarianceScale * noise[u] / (information[u] + 1.0F) + kLeastSigma * kLeastSigma;
      const bool valid = d[u] > 0.0F && variance < largest;  // 0 px means infinite depth
      image.disparity[at] = valid ? d[u] : DisparityImage::kInvalid;
      image.variance[at] = valid ? variance : 0.0F;
    }
  }
}

}  // namespace dense_stereo
