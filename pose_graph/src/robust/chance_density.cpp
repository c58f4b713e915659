// SPDX-License-Identifier: BSD-3-Clause
#include "robust/chance_density.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "linear/index.hpp"
#include "manifold/rotation.hpp"
#include "robust/scattered_bits.hpp"

namespace pose_graph {

namespace {

// Pairs that each density is read off, where few closures are asked for and where many are, and distances in all.
constexpr std::size_t kMostPairs = 50000, kFewestPairs = 2048, kDistances = 20000000;
constexpr std::size_t kNearestPairs = 16;  // good to a quarter
constexpr double kEvenShare = 0.1;
constexpr int kOwnShare = 20, kOwnReach = 10;  // of all poses; poses
constexpr int kAnyOctave = 31;
constexpr double kLeastTurn = 0.01, kLeastShare = 1e-3;  // radians; of the extent
constexpr double kLeastSquare = 1e-12;

int octaveBetween(int from, int to) {
  int octave = 0;
  for (int span = std::abs(to - from); span > 1; span /= 2) ++octave;
  return octave;
}

// Square of the angle between two rotations where it is small; it grows more slowly beyond.
template <int D>
double chordSquare(const Rotation<D>& a, const Rotation<D>& b) {
  return 0.5 * (a - b).squaredNorm();
}

}  // namespace

template <int D>
PoseSample<D>::PoseSample(std::vector<Rigid<D>> poses, double extent, std::vector<std::pair<int, int>> ends)
    : poses_(std::move(poses)), ends_(std::move(ends)) {
  double shift = 0.0, turn = 0.0;
  for (const Rigid<D>& pose : poses_) {
    shift += pose.t.squaredNorm();
    turn += logRotation(pose.R).squaredNorm();
  }
  const double number = static_cast<double>(std::max<std::size_t>(1, poses_.size()));
  shift_ = std::max(std::sqrt(shift / number / D), kLeastShare * extent);
  turn_ = std::max(std::sqrt(turn / number / rotation_size<D>), kLeastTurn);
  // The volume of all rotations is 2 pi, or 8 pi^2.
  even_ = std::pow(2.0 * extent, -D) / (D == 2 ? 2.0 * M_PI : 8.0 * M_PI * M_PI);
}

template <int D>
double PoseSample<D>::logDensity(const Rigid<D>& at, double resolved, const Own& own) const {
  if (poses_.size() < 2 * kNearestPairs) return std::log(even_);
  const double per_shift = 1.0 / (shift_ * shift_), per_turn = 1.0 / (turn_ * turn_);
  const double unit = (tangent_size<D> == 3 ? 4.0 / 3.0 * M_PI : M_PI * M_PI * M_PI / 6.0) * std::pow(shift_, D) *
                      std::pow(turn_, rotation_size<D>);  // volume of the ball of radius 1
  const double least = std::max(std::pow(resolved / unit, 2.0 / tangent_size<D>), kLeastSquare);
  std::vector<double> nearest;  // a heap of squares, the farthest first
  std::size_t within = 0, asked = 0;
  double farthest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (!ends_.empty() && std::abs(ends_[i].first - own.from) <= own.reach &&
        std::abs(ends_[i].second - own.to) <= own.reach)
      continue;
    ++asked;
    const Rigid<D>& pose = poses_[i];
    double square = per_shift * (pose.t - at.t).squaredNorm();
    if (square >= farthest) continue;
    square += per_turn * chordSquare<D>(pose.R, at.R);
    within += square < least;
    if (square >= farthest) continue;
    if (nearest.size() == kNearestPairs) {
      std::pop_heap(nearest.begin(), nearest.end());
      nearest.pop_back();
    }
    nearest.push_back(square);
    std::push_heap(nearest.begin(), nearest.end());
    if (nearest.size() == kNearestPairs) farthest = std::max(nearest.front(), least);
  }
  if (asked < 2 * kNearestPairs) return std::log(even_);
  const double volume = unit * std::pow(farthest, 0.5 * tangent_size<D>);
  const double share = static_cast<double>(std::max(within, kNearestPairs)) / static_cast<double>(asked);
  return std::log((1.0 - kEvenShare) * share / volume + kEvenShare * even_);
}

template <int D>
ChanceDensity<D>::ChanceDensity(const DeadReckoning<D>& chains, const std::vector<Rigid<D>>& poses,
                                std::size_t closures)
    : chains_(chains),
      poses_(poses),
      pairs_(std::clamp(kDistances / std::max<std::size_t>(1, closures), kFewestPairs, kMostPairs)) {}

template <int D>
PoseSample<D> ChanceDensity<D>::sample(int octave) const {
  std::vector<Rigid<D>> pairs;
  std::vector<std::pair<int, int>> ends;
  const std::size_t n = chains_.pose.size();
  const std::size_t shortest = octave == kAnyOctave ? 1 : std::max<std::size_t>(1, (std::size_t{1} << octave) / 2);
  const std::size_t longest = octave == kAnyOctave ? n : std::min(n, std::size_t{4} << octave);
  for (std::uint64_t k = 0; longest > shortest && k < 4 * pairs_ && pairs.size() < pairs_; ++k) {
    const std::size_t from = drawIndex(2 * k, n), to = from + shortest + drawIndex(2 * k + 1, longest - shortest);
    if (to >= n || chains_.of_pose[from] != chains_.of_pose[to]) continue;
    pairs.push_back(poses_[from].inverse() * poses_[to]);
    ends.emplace_back(static_cast<int>(from), static_cast<int>(to));
  }
  return {std::move(pairs), chains_.extent, std::move(ends)};
}

template <int D>
double ChanceDensity<D>::logAt(const Edge<D>& edge, double volume) {
  const int from = edge.from, to = edge.to;
  const int octave = chains_.of_pose[sz(from)] == chains_.of_pose[sz(to)] ? octaveBetween(from, to) : kAnyOctave;
  auto known = of_octave_.find(octave);
  if (known == of_octave_.end()) known = of_octave_.emplace(octave, sample(octave)).first;
  const double resolved =
      std::max(volume, std::sqrt(boundedCovariance<D>(edge.information, chains_.extent).determinant()));
  const int reach = std::clamp(static_cast<int>(chains_.pose.size()) / kOwnShare, 1, kOwnReach);
  return known->second.logDensity(from <= to ? edge.Z : edge.Z.inverse(), resolved,
                                  {std::min(from, to), std::max(from, to), reach});
}

template class PoseSample<2>;
template class PoseSample<3>;
template class ChanceDensity<2>;
template class ChanceDensity<3>;

}  // namespace pose_graph
