// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/second_look.hpp"

#include <algorithm>
#include <cmath>

#include "fabmap_node/recognition/compact_look.hpp"
#include "features/descriptor_source.hpp"
#include "recognition/panorama_matches.hpp"

namespace fabmap_node {
namespace {

constexpr float kVoteWidth = 0.08F;  // side of a vote cell, relative to the image
constexpr int kVoteHalf = 13;        // cells on each side of zero: displacements of up to a whole image
constexpr int kVoteSide = 2 * kVoteHalf + 1;
constexpr float kHorizon = 0.45F;         // relative height in the image below which there is hardly any sky
constexpr std::size_t kFewestBelow = 40;  // features below the horizon that are sufficient for a separate test
constexpr float kStill = 0.006F;          // relative to the image: about 3 px

/// Displacement of a match, and whether it is below the horizon in both observations.
struct Move {
  Eigen::Vector2f by;
  bool is_below = false;
};

/// Numbers of consistent matches, in total and below the horizon.
struct Agreeing {
  int all = 0, below = 0;
};

/// Counts the moves for which `is_among` holds.
template <class IsAmong>
Agreeing countAmong(const std::vector<Move>& moves, const IsAmong& is_among) {
  Agreeing agreeing;
  for (const Move& move : moves)
    if (is_among(move.by)) {
      ++agreeing.all;
      if (move.is_below) ++agreeing.below;
    }
  return agreeing;
}

/// Returns the largest number of displacements in 3x3 adjacent cells.
Agreeing agreeingSingle(const std::vector<Move>& moves) {
  const auto cell = [](float move) { return static_cast<int>(std::lround(move / kVoteWidth)); };
  std::vector<int> votes(static_cast<std::size_t>(kVoteSide * kVoteSide), 0);
  for (const Move& move : moves) {
    const int i = cell(move.by.x()), j = cell(move.by.y());
    if (std::abs(i) > kVoteHalf || std::abs(j) > kVoteHalf) continue;
    ++votes[static_cast<std::size_t>((j + kVoteHalf) * kVoteSide + i + kVoteHalf)];
  }
  int best = 0, best_i = 0, best_j = 0;
  for (int j = 1; j + 1 < kVoteSide; ++j)
    for (int i = 1; i + 1 < kVoteSide; ++i) {
      int sum = 0;
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) sum += votes[static_cast<std::size_t>((j + dj) * kVoteSide + i + di)];
      if (sum <= best) continue;
      best = sum;
      best_i = i - kVoteHalf;
      best_j = j - kVoteHalf;
    }
  if (best == 0) return {};
  return countAmong(moves, [&](const Eigen::Vector2f& by) {
    return std::abs(cell(by.x()) - best_i) <= 1 && std::abs(cell(by.y()) - best_j) <= 1;
  });
}

constexpr double kChanceShare = 9.0 * 0.0064;  // of matches that are consistent by chance: nine cells

bool isBelowHorizon(const Eigen::Vector2f& direction) { return direction.y() > kHorizon; }

std::vector<Move> computeMoves(const ComparedFeatures& a, const ComparedFeatures& b) {
  std::vector<Move> moves;
  for (const auto& [i, j] : mutualMatches(a.descriptors, b.descriptors))
    moves.push_back(
        {b.directions[j] - a.directions[i], isBelowHorizon(a.directions[i]) && isBelowHorizon(b.directions[j])});
  return moves;
}

/// Returns the share of `possible` features that are consistent beyond chance.
double shareBeyondChance(int agreeing, std::size_t matches, std::size_t possible) {
  const double beyond = agreeing - kChanceShare * static_cast<double>(matches);
  return std::clamp(beyond / static_cast<double>(possible), 0.0, 1.0);
}

/// Returns the number of features of a panorama that take the bytes of `single` features of a single image.
std::size_t panoramaFeaturesFor(std::size_t single) { return single * kSingleFeatureBytes / kPanoramaFeatureBytes; }

std::array<unsigned, kLookElements> addAdjacent(const ByteDescriptor& descriptor) {
  std::array<unsigned, kLookElements> elements{};
  for (std::size_t i = 0; i < elements.size(); ++i)
    elements[i] = static_cast<unsigned>(descriptor[2 * i]) + static_cast<unsigned>(descriptor[2 * i + 1]);
  return elements;
}

std::size_t countBelow(const ComparedFeatures& look) {
  return static_cast<std::size_t>(std::count_if(look.directions.begin(), look.directions.end(), isBelowHorizon));
}

}  // namespace

ComparedFeatures selectFeatures(const PlaceObservation& observation, std::size_t most) {
  ComparedFeatures selected;
  selected.cameras = observation.cameras;
  const bool is_panorama = selected.cameras > 1;
  const std::size_t all = observation.features.size();
  const std::size_t count = std::min(all, is_panorama ? panoramaFeaturesFor(most) : most);
  if (!is_panorama) selected.descriptors.resize(Eigen::NoChange, static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    const PlaceFeature& feature = observation.features[k * all / count];
    const auto elements = addAdjacent(feature.descriptor);
    const Eigen::Vector2f direction(static_cast<float>(feature.camera) + feature.u, feature.v);
    if (is_panorama) {
      selected.panorama.push_back(rankElements(elements));
      selected.panorama.back().direction = direction;
      continue;
    }
    auto column = selected.descriptors.col(static_cast<Eigen::Index>(k));
    for (std::size_t i = 0; i < elements.size(); ++i)
      column(static_cast<Eigen::Index>(i)) = static_cast<float>(elements[i]);
    column /= std::max(1.0F, column.norm());
    selected.directions.push_back(direction);
  }
  sortByElevation(selected.panorama);
  return selected;
}

ComparedFeatures thinnedOut(const ComparedFeatures& look, std::size_t step) {
  ComparedFeatures some;
  some.cameras = look.cameras;
  for (std::size_t k = 0; k < look.panorama.size(); k += step) some.panorama.push_back(look.panorama[k]);
  for (std::size_t k = 0; k < look.directions.size(); k += step) some.directions.push_back(look.directions[k]);
  some.descriptors.resize(Eigen::NoChange, static_cast<Eigen::Index>(some.directions.size()));
  for (std::size_t k = 0; k < some.directions.size(); ++k)
    some.descriptors.col(static_cast<Eigen::Index>(k)) = look.descriptors.col(static_cast<Eigen::Index>(k * step));
  return some;
}

LookAgreement secondLook(const ComparedFeatures& a, const ComparedFeatures& b) {
  LookAgreement result;
  if (a.cameras != b.cameras || a.size() == 0 || b.size() == 0) return result;
  if (a.cameras > 1) return comparePanoramas(a, b);
  const std::vector<Move> moves = computeMoves(a, b);
  const Agreeing agreeing = agreeingSingle(moves);
  result.matches = static_cast<int>(moves.size());
  result.agreeing = agreeing.all;
  result.whole = shareBeyondChance(agreeing.all, moves.size(), std::min(a.size(), b.size()));
  result.share = result.whole;
  const std::size_t below = std::min(countBelow(a), countBelow(b));
  if (below < kFewestBelow) return result;
  const auto matches_below = static_cast<std::size_t>(
      std::count_if(moves.begin(), moves.end(), [](const Move& move) { return move.is_below; }));
  result.share = std::min(result.whole, shareBeyondChance(agreeing.below, matches_below, below));
  return result;
}

bool isStationary(const ComparedFeatures& a, const ComparedFeatures& b) {
  if (a.cameras != b.cameras || a.size() == 0 || b.size() == 0) return false;
  std::vector<Move> moves;
  if (a.cameras == 1) moves = computeMoves(a, b);
  else
    for (const PanoramaMatch& match : matchPanoramas(a, b)) moves.push_back({match.displacement()});
  const auto unmoved = std::count_if(moves.begin(), moves.end(), [](const Move& move) {
    return std::abs(move.by.x()) < kStill && std::abs(move.by.y()) < kStill;
  });
  return 2 * static_cast<std::size_t>(unmoved) > std::min(a.size(), b.size());
}

}  // namespace fabmap_node
