// SPDX-License-Identifier: BSD-3-Clause
#include "camera/exposure.hpp"

#include <algorithm>

namespace urban_nav_sim {

/// Returns the `product` of time and gain required by this picture.
double AutoExposure::wanted(const Picture& picture, double product) const {
  const auto channels = static_cast<std::size_t>(picture.channels);
  const double levels = 255.0 * product / settings_.white_seconds;
  double sum = 0.0, count = 0.0;
  for (int v = picture.height / 3; v < picture.height; v += 4) {
    for (int u = 0; u < picture.width; u += 4) {
      // Uses green for colour pictures.
      const std::size_t i = picture.at(u, v) * channels + channels / 2;
      const double level = levels * static_cast<double>(picture.radiance[i]);
      // Saturated pixels are weighted above white; otherwise half of a sunny picture would be saturated.
      sum += level < 255.0 ? level : 400.0;
      count += 1.0;
    }
  }
  // Corrects a third of the error per step; with the lag, full steps would oscillate.
  const double ratio = 1.0 + (settings_.target / std::max(sum / count, 1.0) - 1.0) / 3.0;
  const double next = product * std::clamp(ratio, 1.0 - settings_.step, 1.0 + settings_.step);
  return std::clamp(next, 2e-5, settings_.longest * settings_.largest_gain);
}

Exposure AutoExposure::next(const Picture& picture) {
  if (products_.empty()) {
    double product = settings_.white_seconds;
    for (int i = 0; i < 80; ++i) product = wanted(picture, product);
    products_.assign(static_cast<std::size_t>(settings_.lag), product);
  }
  const double product = products_.front();
  products_.pop_front();
  // The step is relative to the last decision, the error that of this picture.
  const double ratio = settings_.adapts ? wanted(picture, product) / product : 1.0;
  products_.push_back(std::clamp((products_.empty() ? product : products_.back()) * ratio, 2e-5,
                                 settings_.longest * settings_.largest_gain));
  const double seconds = std::min(product, settings_.longest);
  return {seconds, product / seconds};
}

}  // namespace urban_nav_sim
