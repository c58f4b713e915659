// SPDX-License-Identifier: BSD-3-Clause
#include "recognition/mutual_matches.hpp"

namespace fabmap_node {
namespace {

// Lowe (2004), section 7.1: the nearest is right where it is nearer than 0.8 of the distance to the second nearest.
constexpr int kRatioNumerator = 4, kRatioDenominator = 5;
// Mean distance of two descriptors that have nothing in common: two of three equally frequent levels differ by 8/9.
constexpr int kUnrelatedDistance = 8 * static_cast<int>(kLookElements) / 9 + 1;

/// The nearest feature of the other observation so far. One that is unrelated is the second nearest of every feature.
struct Nearest {
  int which = -1;
  int best = kUnrelatedDistance, second = kUnrelatedDistance;

  void see(int i, int distance) {
    if (distance >= second) return;
    if (distance < best) {
      second = best;
      best = distance;
      which = i;
    } else {
      second = distance;
    }
  }
  bool isClear() const { return which >= 0 && kRatioDenominator * best < kRatioNumerator * second; }
};

}  // namespace

int levelDistance(const LookFeature& a, const LookFeature& b) {
  return __builtin_popcountll(a.middle ^ b.middle) + __builtin_popcountll(a.top ^ b.top);
}

std::vector<Eigen::Vector2f> mutualMatches(const LookFeatures& a, const LookFeatures& b, float height_band) {
  std::vector<Nearest> of_a(a.size()), of_b(b.size());
  std::size_t begin = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const LookFeature& feature = a.features[i];
    const float lowest = feature.height - height_band, highest = feature.height + height_band;
    while (begin < b.size() && b.features[begin].height < lowest) ++begin;
    for (std::size_t j = begin; j < b.size() && b.features[j].height <= highest; ++j) {
      const int distance = levelDistance(feature, b.features[j]);
      of_a[i].see(static_cast<int>(j), distance);
      of_b[j].see(static_cast<int>(i), distance);
    }
  }
  std::vector<Eigen::Vector2f> displacements;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!of_a[i].isClear()) continue;
    const auto j = static_cast<std::size_t>(of_a[i].which);
    if (of_b[j].which != static_cast<int>(i) || !of_b[j].isClear()) continue;
    displacements.emplace_back(b.features[j].azimuth - a.features[i].azimuth,
                               b.features[j].height - a.features[i].height);
  }
  return displacements;
}

}  // namespace fabmap_node
