// SPDX-License-Identifier: BSD-3-Clause
#include "recognition/panorama_matches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fabmap_node {
namespace {

// Lowe (2004), section 7.1: a nearest neighbour closer than 0.8 of the distance to the second nearest is correct.
constexpr int kRatioNumerator = 4, kRatioDenominator = 5;
// Mean distance of two unrelated descriptors: two of three equally frequent levels differ by 8/9.
constexpr int kUnrelatedDistance = 8 * kLookElements / 9 + 1;
constexpr float kSameElevation = 0.12F;  // share of the image's height
constexpr int kHeadingsPerCamera = 7;    // vote bins of the change of heading, about 10 deg each for five cameras
constexpr int kAdjacentBins = 3;
// A tenth of the image's height is about 10 deg. A wall of 6 m that appears nearer to the horizon is more than 30 m
// away, and 10 m of travel, the distance between two places, change its appearance little.
constexpr float kLevelView = 0.5F, kNearLevel = 0.1F;
constexpr std::size_t kFewestFeatures = 40;  // near the horizon, and away from it; fewer count as so many
// Ascending ranks of the 64 elements at the limits of three equally frequent levels, which hold the most information.
constexpr std::size_t kLowerLimit = 20, kUpperLimit = 42;

/// The nearest feature of the other panorama. The second nearest is at most as far away as an unrelated one.
struct Nearest {
  int which = -1;
  int best = kUnrelatedDistance, second = kUnrelatedDistance;

  void add(std::size_t i, int distance) {
    if (distance >= second) return;
    if (distance < best) {
      second = best;
      best = distance;
      which = static_cast<int>(i);
    } else {
      second = distance;
    }
  }
  bool isClear() const { return which >= 0 && kRatioDenominator * best < kRatioNumerator * second; }
};

/// Numbers of matches: in total, with both features near the horizon, and with both away from it.
struct MatchCount {
  int all = 0, level = 0, away = 0;

  MatchCount& operator+=(const MatchCount& other) {
    all += other.all;
    level += other.level;
    away += other.away;
    return *this;
  }
};

bool isLevel(const Eigen::Vector2f& direction) { return std::abs(direction.y() - kLevelView) <= kNearLevel; }

std::size_t countLevel(const ComparedFeatures& features) {
  return static_cast<std::size_t>(std::count_if(features.panorama.begin(), features.panorama.end(),
                                                [](const PanoramaFeature& f) { return isLevel(f.direction); }));
}

/// Returns the numbers of matches by change of heading.
std::vector<MatchCount> countByHeading(const std::vector<PanoramaMatch>& matches, int cameras) {
  const int bins = kHeadingsPerCamera * cameras;
  std::vector<MatchCount> counts(static_cast<std::size_t>(bins));
  for (const PanoramaMatch& match : matches) {
    const int turn = static_cast<int>(std::lround(match.displacement().x() * kHeadingsPerCamera));
    const bool a = isLevel(match.a), b = isLevel(match.b);
    counts[static_cast<std::size_t>((turn % bins + bins) % bins)] += {1, a && b ? 1 : 0, a || b ? 0 : 1};
  }
  return counts;
}

/// Returns the sum of three adjacent changes of heading with the most matches; the first of equal ones.
MatchCount countOfBestHeading(const std::vector<MatchCount>& counts) {
  MatchCount best;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    MatchCount sum;
    for (std::size_t k = 0; k < kAdjacentBins; ++k) sum += counts[(i + k) % counts.size()];
    if (sum.all > best.all) best = sum;
  }
  return best;
}

/// Returns the share of `possible` features that are consistent beyond chance.
double shareBeyondChance(int agreeing, int matches, int cameras, std::size_t possible) {
  const double by_chance = static_cast<double>(kAdjacentBins) / (kHeadingsPerCamera * cameras) * matches;
  return std::clamp((agreeing - by_chance) / static_cast<double>(possible), 0.0, 1.0);
}

}  // namespace

int levelDistance(const PanoramaFeature& a, const PanoramaFeature& b) {
  return __builtin_popcountll(a.middle ^ b.middle) + __builtin_popcountll(a.top ^ b.top);
}

PanoramaFeature rankElements(const std::array<unsigned, kLookElements>& elements) {
  std::array<unsigned, kLookElements> ranked = elements;
  std::sort(ranked.begin(), ranked.end());
  PanoramaFeature feature;
  feature.direction.setZero();
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const std::uint64_t bit = std::uint64_t{1} << k;
    if (elements[k] > ranked[kLowerLimit]) feature.middle |= bit;
    if (elements[k] > ranked[kUpperLimit]) feature.top |= bit;
  }
  return feature;
}

void sortByElevation(std::vector<PanoramaFeature>& features) {
  std::stable_sort(features.begin(), features.end(), [](const PanoramaFeature& a, const PanoramaFeature& b) {
    return std::pair(a.direction.y(), a.direction.x()) < std::pair(b.direction.y(), b.direction.x());
  });
}

std::vector<PanoramaMatch> matchPanoramas(const ComparedFeatures& a, const ComparedFeatures& b) {
  std::vector<Nearest> of_a(a.panorama.size()), of_b(b.panorama.size());
  std::size_t begin = 0;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const PanoramaFeature& feature = a.panorama[i];
    const float lowest = feature.direction.y() - kSameElevation, highest = feature.direction.y() + kSameElevation;
    while (begin < of_b.size() && b.panorama[begin].direction.y() < lowest) ++begin;
    for (std::size_t j = begin; j < of_b.size() && b.panorama[j].direction.y() <= highest; ++j) {
      const int distance = levelDistance(feature, b.panorama[j]);
      of_a[i].add(j, distance);
      of_b[j].add(i, distance);
    }
  }
  std::vector<PanoramaMatch> matches;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (!of_a[i].isClear()) continue;
    const auto j = static_cast<std::size_t>(of_a[i].which);
    if (of_b[j].which == static_cast<int>(i) && of_b[j].isClear())
      matches.push_back({a.panorama[i].direction, b.panorama[j].direction});
  }
  return matches;
}

LookAgreement comparePanoramas(const ComparedFeatures& a, const ComparedFeatures& b) {
  const std::vector<MatchCount> counts = countByHeading(matchPanoramas(a, b), a.cameras);
  const MatchCount best = countOfBestHeading(counts);
  MatchCount total;
  for (const MatchCount& count : counts) total += count;
  LookAgreement result;
  result.matches = total.all;
  result.agreeing = best.all;
  result.whole = shareBeyondChance(best.all, total.all, a.cameras, std::min(a.size(), b.size()));
  const std::size_t level_a = countLevel(a), level_b = countLevel(b);
  const double level =
      shareBeyondChance(best.level, total.level, a.cameras, std::max(kFewestFeatures, std::min(level_a, level_b)));
  const double away = shareBeyondChance(best.away, total.away, a.cameras,
                                        std::max(kFewestFeatures, std::min(a.size() - level_a, b.size() - level_b)));
  result.share = std::sqrt(level * away);
  return result;
}

}  // namespace fabmap_node
