// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/second_look.hpp"

#include <algorithm>
#include <cmath>

#include "features/descriptor_source.hpp"

namespace fabmap_node {
namespace {

constexpr float kVoteWidth = 0.08F;  // side of a vote cell, relative to the image
constexpr int kVoteHalf = 13;        // cells on each side of zero: displacements of up to a whole image
constexpr int kVoteSide = 2 * kVoteHalf + 1;
constexpr int kHeadingsPerCamera = 7;     // vote bins of the change of heading, about 10 deg each for five cameras
constexpr float kSameHeight = 0.12F;      // share of the image's height
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

/// Returns the largest number of changes of heading in three adjacent bins, among matches at the same height.
Agreeing agreeingPanorama(const std::vector<Move>& moves, int cameras) {
  const int bins = kHeadingsPerCamera * cameras;
  const auto bin = [bins](float turn) {
    return (static_cast<int>(std::lround(turn * kHeadingsPerCamera)) % bins + bins) % bins;
  };
  std::vector<int> votes(static_cast<std::size_t>(bins), 0);
  for (const Move& move : moves)
    if (std::abs(move.by.y()) <= kSameHeight) ++votes[static_cast<std::size_t>(bin(move.by.x()))];
  int best = 0, best_bin = 0;
  for (int i = 0; i < bins; ++i) {
    const int sum = votes[static_cast<std::size_t>(i)] + votes[static_cast<std::size_t>((i + 1) % bins)] +
                    votes[static_cast<std::size_t>((i + 2) % bins)];
    if (sum <= best) continue;
    best = sum;
    best_bin = i;
  }
  if (best == 0) return {};
  return countAmong(moves, [&](const Eigen::Vector2f& by) {
    return std::abs(by.y()) <= kSameHeight && (bin(by.x()) - best_bin + bins) % bins <= 2;
  });
}

/// Returns the share of matches that are consistent by chance.
double chanceShare(int cameras) {
  return cameras > 1 ? 3.0 / (kHeadingsPerCamera * cameras) * 2.0 * static_cast<double>(kSameHeight) : 9.0 * 0.0064;
}

bool isBelowHorizon(const Eigen::Vector2f& direction) { return direction.y() > kHorizon; }

std::vector<Move> computeMoves(const LookFeatures& a, const LookFeatures& b) {
  std::vector<Move> moves;
  for (const auto& [i, j] : mutualMatches(a.descriptors, b.descriptors))
    moves.push_back(
        {b.directions[j] - a.directions[i], isBelowHorizon(a.directions[i]) && isBelowHorizon(b.directions[j])});
  return moves;
}

/// Returns the share of `possible` features that are consistent beyond chance.
double shareBeyondChance(int agreeing, std::size_t matches, int cameras, std::size_t possible) {
  const double beyond = agreeing - chanceShare(cameras) * static_cast<double>(matches);
  return std::clamp(beyond / static_cast<double>(possible), 0.0, 1.0);
}

std::size_t countBelow(const LookFeatures& look) {
  return static_cast<std::size_t>(std::count_if(look.directions.begin(), look.directions.end(), isBelowHorizon));
}

}  // namespace

LookFeatures lookFeatures(const PlaceObservation& observation, std::size_t most) {
  LookFeatures look;
  look.cameras = observation.cameras;
  const std::size_t all = observation.features.size(), count = std::min(all, most);
  look.descriptors.resize(Eigen::NoChange, static_cast<Eigen::Index>(count));
  look.directions.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const PlaceFeature& feature = observation.features[k * all / count];
    auto column = look.descriptors.col(static_cast<Eigen::Index>(k));
    for (std::size_t i = 0; i < kDescriptorBytes / 2; ++i)
      column(static_cast<Eigen::Index>(i)) =
          static_cast<float>(feature.descriptor[2 * i]) + static_cast<float>(feature.descriptor[2 * i + 1]);
    column /= std::max(1.0F, column.norm());
    look.directions.emplace_back(static_cast<float>(feature.camera) + feature.u, feature.v);
  }
  return look;
}

LookFeatures thinnedOut(const LookFeatures& look, std::size_t step) {
  LookFeatures some;
  some.cameras = look.cameras;
  const std::size_t count = (look.size() + step - 1) / step;
  some.descriptors.resize(Eigen::NoChange, static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    some.descriptors.col(static_cast<Eigen::Index>(k)) = look.descriptors.col(static_cast<Eigen::Index>(k * step));
    some.directions.push_back(look.directions[k * step]);
  }
  return some;
}

LookAgreement secondLook(const LookFeatures& a, const LookFeatures& b) {
  LookAgreement result;
  if (a.cameras != b.cameras || a.size() == 0 || b.size() == 0) return result;
  const std::vector<Move> moves = computeMoves(a, b);
  const Agreeing agreeing = a.cameras > 1 ? agreeingPanorama(moves, a.cameras) : agreeingSingle(moves);
  result.matches = static_cast<int>(moves.size());
  result.agreeing = agreeing.all;
  result.whole = shareBeyondChance(agreeing.all, moves.size(), a.cameras, std::min(a.size(), b.size()));
  result.share = result.whole;
  const std::size_t below = std::min(countBelow(a), countBelow(b));
  if (below < kFewestBelow) return result;
  const auto matches_below = static_cast<std::size_t>(
      std::count_if(moves.begin(), moves.end(), [](const Move& move) { return move.is_below; }));
  result.share = std::min(result.whole, shareBeyondChance(agreeing.below, matches_below, a.cameras, below));
  return result;
}

bool isStationary(const LookFeatures& a, const LookFeatures& b) {
  if (a.cameras != b.cameras || a.size() == 0 || b.size() == 0) return false;
  const std::vector<Move> moves = computeMoves(a, b);
  const auto unmoved = std::count_if(moves.begin(), moves.end(), [](const Move& move) {
    return std::abs(move.by.x()) < kStill && std::abs(move.by.y()) < kStill;
  });
  return 2 * static_cast<std::size_t>(unmoved) > std::min(a.size(), b.size());
}

}  // namespace fabmap_node
