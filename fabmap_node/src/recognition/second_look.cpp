// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/second_look.hpp"

#include <algorithm>
#include <cmath>

#include "features/descriptor_source.hpp"

namespace fabmap_node {
namespace {

constexpr float vote_width = 0.08F;  // side of a cell of votes, shares of the image
constexpr int vote_half = 13;        // cells on each side of zero: displacements of up to a whole image
constexpr int vote_side = 2 * vote_half + 1;
constexpr int headings_per_camera = 7;  // votes for a change of heading, about 10 deg each for five cameras
constexpr float same_height = 0.12F;    // share of the image's height
constexpr float still = 0.006F;         // share of the image: some 3 px

/// Largest number of displacements in 3x3 neighbouring cells.
int agreeingSingle(const std::vector<Eigen::Vector2f>& moves) {
  std::vector<int> votes(static_cast<std::size_t>(vote_side * vote_side), 0);
  for (const Eigen::Vector2f& move : moves) {
    const int i = static_cast<int>(std::lround(move.x() / vote_width)),
              j = static_cast<int>(std::lround(move.y() / vote_width));
    if (std::abs(i) > vote_half || std::abs(j) > vote_half) continue;
    ++votes[static_cast<std::size_t>((j + vote_half) * vote_side + i + vote_half)];
  }
  int best = 0;
  for (int j = 1; j + 1 < vote_side; ++j)
    for (int i = 1; i + 1 < vote_side; ++i) {
      int sum = 0;
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) sum += votes[static_cast<std::size_t>((j + dj) * vote_side + i + di)];
      best = std::max(best, sum);
    }
  return best;
}

/// Largest number of changes of heading in three neighbouring bins, of matches at the same height.
int agreeingPanorama(const std::vector<Eigen::Vector2f>& moves, int cameras) {
  const int bins = headings_per_camera * cameras;
  std::vector<int> votes(static_cast<std::size_t>(bins), 0);
  for (const Eigen::Vector2f& move : moves) {
    if (std::abs(move.y()) > same_height) continue;
    const int bin = static_cast<int>(std::lround(move.x() * headings_per_camera)) % bins;
    ++votes[static_cast<std::size_t>((bin + bins) % bins)];
  }
  int best = 0;
  for (int i = 0; i < bins; ++i)
    best = std::max(best, votes[static_cast<std::size_t>(i)] + votes[static_cast<std::size_t>((i + 1) % bins)] +
                              votes[static_cast<std::size_t>((i + 2) % bins)]);
  return best;
}

/// Share of matches that agree by chance.
double chanceShare(int cameras) {
  return cameras > 1 ? 3.0 / (headings_per_camera * cameras) * 2.0 * static_cast<double>(same_height) : 9.0 * 0.0064;
}

std::vector<Eigen::Vector2f> computeMoves(const LookFeatures& a, const LookFeatures& b) {
  std::vector<Eigen::Vector2f> moves;
  for (const auto& [i, j] : mutualMatches(a.descriptors, b.descriptors))
    moves.push_back(b.directions[j] - a.directions[i]);
  return moves;
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
    for (std::size_t i = 0; i < descriptor_bytes / 2; ++i)
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
  const std::vector<Eigen::Vector2f> moves = computeMoves(a, b);
  result.matches = static_cast<int>(moves.size());
  result.agreeing = a.cameras > 1 ? agreeingPanorama(moves, a.cameras) : agreeingSingle(moves);
  const double beyond = result.agreeing - chanceShare(a.cameras) * result.matches;
  result.share = std::clamp(beyond / static_cast<double>(std::min(a.size(), b.size())), 0.0, 1.0);
  return result;
}

bool isStationary(const LookFeatures& a, const LookFeatures& b) {
  if (a.cameras != b.cameras || a.size() == 0 || b.size() == 0) return false;
  const std::vector<Eigen::Vector2f> moves = computeMoves(a, b);
  const auto unmoved = std::count_if(moves.begin(), moves.end(), [](const Eigen::Vector2f& move) {
    return std::abs(move.x()) < still && std::abs(move.y()) < still;
  });
  return 2 * static_cast<std::size_t>(unmoved) > std::min(a.size(), b.size());
}

}  // namespace fabmap_node
