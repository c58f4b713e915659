// SPDX-License-Identifier: BSD-3-Clause
#include "colour/image_gains.hpp"

#include <algorithm>
#include <cmath>

namespace laser_mapper {

namespace {

constexpr int kGainRounds = 12;
constexpr std::size_t kLeastShared = 8;  // points shared with other images

float medianInPlace(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Estimates one channel: logarithms of the gains.
std::vector<float> channelGains(std::size_t views, std::size_t points, std::size_t channel,
                                const std::vector<ColourObservation>& observations) {
  std::vector<float> gains(views, 0.0F);
  std::vector<std::vector<float>> ratios(views);
  for (int round = 0; round < kGainRounds; ++round) {
    std::vector<float> sums(points, 0.0F), counts(points, 0.0F);
    for (const ColourObservation& each : observations) {
      sums[each.point] += std::log(each.colour[channel]) + gains[each.view];
      counts[each.point] += 1.0F;
    }
    for (std::vector<float>& of_view : ratios) of_view.clear();
    for (const ColourObservation& each : observations)
      if (counts[each.point] > 1.0F)
        ratios[each.view].push_back(sums[each.point] / counts[each.point] - std::log(each.colour[channel]));
    std::vector<float> known;
    for (std::size_t view = 0; view < views; ++view) {
      if (ratios[view].size() < kLeastShared) continue;
      gains[view] = medianInPlace(ratios[view]);
      known.push_back(gains[view]);
    }
    if (known.empty()) return gains;
    const float middle = medianInPlace(known);
    for (std::size_t view = 0; view < views; ++view)
      if (ratios[view].size() >= kLeastShared) gains[view] -= middle;
  }
  return gains;
}

}  // namespace

std::vector<std::array<float, 3>> estimateGains(std::size_t views, std::size_t points,
                                                const std::vector<ColourObservation>& observations) {
  std::vector<std::array<float, 3>> gains(views, {1.0F, 1.0F, 1.0F});
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const std::vector<float> logarithms = channelGains(views, points, channel, observations);
    for (std::size_t view = 0; view < views; ++view)
      gains[view][channel] = std::exp(std::clamp(logarithms[view], -1.5F, 1.5F));
  }
  return gains;
}

}  // namespace laser_mapper
