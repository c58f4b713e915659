// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/second_look.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "recognition/mutual_matches.hpp"

namespace fabmap_node {
namespace {

constexpr float kVoteWidth = 0.08F;  // side of a cell of votes, shares of the image
constexpr int kVoteHalf = 13;        // cells on each side of zero: displacements of up to a whole image
constexpr int kVoteSide = 2 * kVoteHalf + 1;
constexpr int kHeadingsPerCamera = 7;    // votes for a change of heading, about 10 deg each for five cameras
constexpr float kSameHeight = 0.12F;     // share of the image's height
constexpr float kWholeHeight = 1.0F;     // of the image: a single camera pitches and comes nearer
constexpr float kStill = 0.006F;         // share of the image: some 3 px
constexpr std::size_t kLowerLimit = 20;  // ascending ranks of the 64 elements at the limits of three equal levels,
constexpr std::size_t kUpperLimit = 42;  // which hold the most information

using Displacements = std::vector<Eigen::Vector2f>;

/// Largest number of displacements in 3x3 neighbouring cells.
int agreeingSingle(const Displacements& displacements) {
  const auto cell = [](float share) { return static_cast<int>(std::lround(share / kVoteWidth)); };
  std::vector<int> votes(static_cast<std::size_t>(kVoteSide * kVoteSide), 0);
  for (const Eigen::Vector2f& by : displacements) {
    const int i = cell(by.x()), j = cell(by.y());
    if (std::abs(i) > kVoteHalf || std::abs(j) > kVoteHalf) continue;
    ++votes[static_cast<std::size_t>((j + kVoteHalf) * kVoteSide + i + kVoteHalf)];
  }
  int best = 0;
  for (int j = 1; j + 1 < kVoteSide; ++j)
    for (int i = 1; i + 1 < kVoteSide; ++i) {
      int sum = 0;
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) sum += votes[static_cast<std::size_t>((j + dj) * kVoteSide + i + di)];
      best = std::max(best, sum);
    }
  return best;
}

/// Largest number of changes of heading in three neighbouring bins.
int agreeingPanorama(const Displacements& displacements, int cameras) {
  const int bins = kHeadingsPerCamera * cameras;
  std::vector<int> votes(static_cast<std::size_t>(bins), 0);
  for (const Eigen::Vector2f& by : displacements) {
    const int turn = static_cast<int>(std::lround(by.x() * kHeadingsPerCamera));
    ++votes[static_cast<std::size_t>((turn % bins + bins) % bins)];
  }
  int best = 0;
  for (int i = 0; i < bins; ++i)
    best = std::max(best, votes[static_cast<std::size_t>(i)] + votes[static_cast<std::size_t>((i + 1) % bins)] +
                              votes[static_cast<std::size_t>((i + 2) % bins)]);
  return best;
}

/// Share of matches that agree by chance.
double chanceShare(int cameras) {
  return cameras > 1 ? 3.0 / (kHeadingsPerCamera * cameras) : 9.0 * static_cast<double>(kVoteWidth * kVoteWidth);
}

float heightBand(int cameras) { return cameras > 1 ? kSameHeight : kWholeHeight; }

bool areComparable(const LookFeatures& a, const LookFeatures& b) {
  return a.cameras == b.cameras && a.size() > 0 && b.size() > 0;
}

}  // namespace

LookFeature lookFeature(const LookElements& elements, float azimuth, float height) {
  LookElements ranked = elements;
  std::sort(ranked.begin(), ranked.end());
  LookFeature feature;
  for (std::size_t k = 0; k < kLookElements; ++k) {
    const std::uint64_t bit = std::uint64_t{1} << k;
    if (elements[k] > ranked[kLowerLimit]) feature.middle |= bit;
    if (elements[k] > ranked[kUpperLimit]) feature.top |= bit;
  }
  feature.azimuth = azimuth;
  feature.height = height;
  return feature;
}

void sortByHeight(std::vector<LookFeature>& features) {
  std::stable_sort(features.begin(), features.end(), [](const LookFeature& a, const LookFeature& b) {
    return a.height != b.height ? a.height < b.height : a.azimuth < b.azimuth;
  });
}

LookFeatures lookFeatures(const PlaceObservation& observation, std::size_t most) {
  LookFeatures look;
  look.cameras = observation.cameras;
  const std::size_t all = observation.features.size(), count = std::min(all, most);
  look.features.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const PlaceFeature& feature = observation.features[k * all / count];
    LookElements elements{};
    for (std::size_t i = 0; i < kLookElements; ++i)
      elements[i] = static_cast<std::uint16_t>(feature.descriptor[2 * i] + feature.descriptor[2 * i + 1]);
    look.features.push_back(lookFeature(elements, static_cast<float>(feature.camera) + feature.u, feature.v));
  }
  sortByHeight(look.features);
  return look;
}

LookAgreement secondLook(const LookFeatures& a, const LookFeatures& b) {
  LookAgreement result;
  if (!areComparable(a, b)) return result;
  const Displacements displacements = mutualMatches(a, b, heightBand(a.cameras));
  result.matches = static_cast<int>(displacements.size());
  result.agreeing = a.cameras > 1 ? agreeingPanorama(displacements, a.cameras) : agreeingSingle(displacements);
  const double beyond = result.agreeing - chanceShare(a.cameras) * result.matches;
  result.share = std::clamp(beyond / static_cast<double>(std::min(a.size(), b.size())), 0.0, 1.0);
  return result;
}

bool isStationary(const LookFeatures& a, const LookFeatures& b) {
  if (!areComparable(a, b)) return false;
  const Displacements displacements = mutualMatches(a, b, heightBand(a.cameras));
  const auto unmoved = std::count_if(displacements.begin(), displacements.end(), [](const Eigen::Vector2f& by) {
    return std::abs(by.x()) < kStill && std::abs(by.y()) < kStill;
  });
  return 2 * static_cast<std::size_t>(unmoved) > std::min(a.size(), b.size());
}

}  // namespace fabmap_node
