// SPDX-License-Identifier: BSD-3-Clause
#include "robust/evidence/chance_density.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>

#include "linear/index.hpp"
#include "manifold/rotation.hpp"

namespace pose_graph {

namespace {

// Number of pairs for many queries, and limit of distances evaluated in all queries.
constexpr std::size_t kFewestPairs = 2048, kDistances = 20000000;
constexpr std::size_t kNearestPairs = 16;  // accurate to a quarter
constexpr double kEvenShare = 0.1;
constexpr int kOwnShare = 20;                            // share of all poses
constexpr double kLeastTurn = 0.01, kLeastShare = 1e-3;  // rad; share of the extent
constexpr double kLeastSquare = 1e-12;

int octaveBetween(int from, int to) {
  int octave = 0;
  for (int span = std::abs(to - from); span > 1; span /= 2) ++octave;
  return octave;
}

// Returns the squared rotation angle for small angles; a lower value for large ones.
template <int D>
double chordSquare(const Rotation<D>& a, const Rotation<D>& b) {
  return 0.5 * (a - b).squaredNorm();
}

}  // namespace

template <int D>
PoseSample<D>::PoseSample(std::vector<Rigid<D>> poses, double extent, std::vector<std::pair<int, int>> ends)
    : poses_(std::move(poses)), ends_(std::move(ends)) {
  double turn = 0.0;
  Eigen::Matrix<double, D, 1> shift = Eigen::Matrix<double, D, 1>::Zero();
  for (const Rigid<D>& pose : poses_) {
    shift += pose.t.cwiseAbs2();
    turn += logRotation(pose.R).squaredNorm();
  }
  const double number = static_cast<double>(std::max<std::size_t>(1, poses_.size()));
  shift_ = std::max(std::sqrt(shift.sum() / number / D), kLeastShare * extent);
  turn_ = std::max(std::sqrt(turn / number / kRotationSize<D>), kLeastTurn);
  // The volume of all rotations is 2 pi, or 8 pi^2.
  even_ = std::pow(2.0 * extent, -D) / (D == 2 ? 2.0 * M_PI : 8.0 * M_PI * M_PI);
  shift.maxCoeff(&axis_);
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(poses_.size());
  for (std::size_t i = 0; i < poses_.size(); ++i) order.emplace_back(poses_[i].t[axis_], i);
  std::sort(order.begin(), order.end());
  std::vector<Rigid<D>> sorted;
  std::vector<std::pair<int, int>> sorted_ends;
  sorted.reserve(order.size());
  for (const auto& [coordinate, i] : order) {
    sorted.push_back(poses_[i]);
    if (!ends_.empty()) sorted_ends.push_back(ends_[i]);
  }
  poses_ = std::move(sorted);
  by_ends_ = std::exchange(ends_, std::move(sorted_ends));
  std::sort(by_ends_.begin(), by_ends_.end());
}

template <int D>
std::size_t PoseSample<D>::count(const Own& own) const {
  std::size_t made = 0;
  auto at = std::lower_bound(by_ends_.begin(), by_ends_.end(), std::make_pair(own.from - own.reach, 0));
  for (; at != by_ends_.end() && at->first <= own.from + own.reach; ++at)
    made += std::abs(at->second - own.to) <= own.reach;
  return made;
}

template <int D>
double PoseSample<D>::logDensity(const Rigid<D>& at, double resolved, const Own& own) const {
  const std::size_t asked = poses_.size() - count(own);
  if (asked < 2 * kNearestPairs) return std::log(even_);
  const double per_shift = 1.0 / (shift_ * shift_), per_turn = 1.0 / (turn_ * turn_);
  const double unit = (kTangentSize<D> == 3 ? 4.0 / 3.0 * M_PI : M_PI * M_PI * M_PI / 6.0) * std::pow(shift_, D) *
                      std::pow(turn_, kRotationSize<D>);  // volume of the ball of radius 1
  const double least = std::max(std::pow(resolved / unit, 2.0 / kTangentSize<D>), kLeastSquare);
  std::vector<double> nearest;  // max-heap of squared distances
  std::size_t within = 0;
  double farthest = std::numeric_limits<double>::infinity();
  const auto addSample = [&](std::size_t i) {
    const Rigid<D>& pose = poses_[i];
    double square = per_shift * (pose.t - at.t).squaredNorm();
    if (square >= farthest) return;
    square += per_turn * chordSquare<D>(pose.R, at.R);
    if (square >= farthest) return;
    if (!ends_.empty() && std::abs(ends_[i].first - own.from) <= own.reach &&
        std::abs(ends_[i].second - own.to) <= own.reach)
      return;
    within += square < least;
    if (nearest.size() == kNearestPairs) {
      std::pop_heap(nearest.begin(), nearest.end());
      nearest.pop_back();
    }
    nearest.push_back(square);
    std::push_heap(nearest.begin(), nearest.end());
    if (nearest.size() == kNearestPairs) farthest = std::max(nearest.front(), least);
  };
  // Visits samples in ascending distance along the widest axis, on both sides, until none can be among the nearest.
  const double middle = at.t[axis_];
  std::size_t above = static_cast<std::size_t>(
      std::lower_bound(poses_.begin(), poses_.end(), middle,
                       [this](const Rigid<D>& pose, double value) { return pose.t[axis_] < value; }) -
      poses_.begin());
  std::size_t below = above;
  const auto distance = [&](std::size_t i) { return std::abs(poses_[i].t[axis_] - middle); };
  while (below > 0 || above < poses_.size()) {
    const bool up = below == 0 || (above < poses_.size() && distance(above) < distance(below - 1));
    const std::size_t next = up ? above++ : --below;
    if (per_shift * distance(next) * distance(next) >= farthest) break;
    addSample(next);
  }
  const double volume = unit * std::pow(farthest, 0.5 * kTangentSize<D>);
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
PoseSample<D> ChanceDensity<D>::sample(std::optional<int> octave) const {
  std::vector<Rigid<D>> pairs;
  std::vector<std::pair<int, int>> ends;
  const std::size_t n = chains_.pose.size();
  const std::size_t shortest = octave ? std::max<std::size_t>(1, (std::size_t{1} << *octave) / 2) : 1;
  const std::size_t longest = octave ? std::min(n, std::size_t{4} << *octave) : n;
  const auto take = [&](std::size_t from, std::size_t to) {
    if (to >= n || chains_.of_pose[from] != chains_.of_pose[to]) return;
    pairs.push_back(poses_[from].inverse() * poses_[to]);
    ends.emplace_back(static_cast<int>(from), static_cast<int>(to));
  };
  if (longest > shortest && n * (longest - shortest) <= pairs_) {  // all pairs
    for (std::size_t from = 0; from < n; ++from)
      for (std::size_t to = from + shortest; to < from + longest; ++to) take(from, to);
    return {std::move(pairs), chains_.extent, std::move(ends)};
  }
  for (std::uint64_t k = 0; longest > shortest && k < 4 * pairs_ && pairs.size() < pairs_; ++k) {
    const std::size_t from = drawIndex(2 * k, n);
    take(from, from + shortest + drawIndex(2 * k + 1, longest - shortest));
  }
  return {std::move(pairs), chains_.extent, std::move(ends)};
}

template <int D>
double ChanceDensity<D>::logAt(const Edge<D>& edge, double volume) {
  const int from = edge.from, to = edge.to;
  std::optional<int> octave;  // none between two chains
  if (chains_.of_pose[sz(from)] == chains_.of_pose[sz(to)]) octave = octaveBetween(from, to);
  auto known = of_octave_.find(octave);
  if (known == of_octave_.end()) known = of_octave_.emplace(octave, sample(octave)).first;
  const double resolved =
      std::max(volume, std::sqrt(boundedCovariance<D>(edge.information, chains_.extent).determinant()));
  const int reach = std::clamp(static_cast<int>(chains_.pose.size()) / kOwnShare, 1, kRowReach);
  return known->second.logDensity(from <= to ? edge.Z : edge.Z.inverse(), resolved,
                                  {std::min(from, to), std::max(from, to), reach});
}

template class PoseSample<2>;
template class PoseSample<3>;
template class ChanceDensity<2>;
template class ChanceDensity<3>;

}  // namespace pose_graph
