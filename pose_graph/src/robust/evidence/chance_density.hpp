// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "robust/evidence/dead_reckoning.hpp"

namespace pose_graph {

/// Pairs of poses that a density is read off: with 16 within its ball the smallest is a five hundredth.
constexpr std::size_t kMostPairs = 8192;

/// Relative poses drawn from what a map offers, and their density anywhere, by the distance to the nearest few
/// (Loftsgaarden, Quesenberry, A nonparametric estimate of a multivariate density function, 1965).
template <int D>
class PoseSample {
 public:
  PoseSample() = default;
  /// `extent`: of the map, metres. `ends`: the numbers of the two poses that each lies between, or none.
  PoseSample(std::vector<Rigid<D>> poses, double extent, std::vector<std::pair<int, int>> ends = {});

  /// Pairs of poses that are the one in question, more or less: no chance.
  struct Own {
    int from = 0, to = 0, reach = -1;
  };

  /// Logarithm, per metre^D and radian^(directions of rotation), over no less than `volume` of these: what a
  /// measurement does not resolve tells nothing; without the pair in question. A tenth of it is even over the extent,
  /// as no sample knows all.
  double logDensity(const Rigid<D>& at, double volume = 0.0, const Own& own = {}) const;

 private:
  // How many lie between the poses in question, more or less.
  std::size_t count(const Own& own) const;

  std::vector<Rigid<D>> poses_;                      // in the order of axis_
  std::vector<std::pair<int, int>> ends_, by_ends_;  // of each of them; sorted
  Eigen::Index axis_ = 0;                            // along which they are spread widest
  double shift_ = 1.0, turn_ = 1.0;                  // root mean squares of one coordinate, metres and radians
  double even_ = 1.0;
};

/// How likely two poses of a map that have nothing to do with each other lie as a closure measures: the density of
/// chance agreement, measured on the map itself, over pairs of poses about as far apart in number as the closure's. A
/// map with streets in two directions has four times as many parallel pairs as an even spread of headings has, and
/// places on a curved way are alike in heading where they are near. Between two chains, whose frames have nothing to do
/// with each other, pairs of all distances stand for theirs.
template <int D>
class ChanceDensity {
 public:
  /// Of the map that dead reckoning gives. `closures`: how many will be asked for; of many, each sees fewer pairs.
  ChanceDensity(const DeadReckoning<D>& chains, std::size_t closures) : ChanceDensity(chains, chains.pose, closures) {}
  /// Of the map that these poses are, by the same pairs. Both must outlive it.
  ChanceDensity(const DeadReckoning<D>& chains, const std::vector<Rigid<D>>& poses, std::size_t closures);

  /// As PoseSample::logDensity(), of what an edge measures, over what it resolves and no less than `volume`.
  double logAt(const Edge<D>& edge, double volume = 0.0);

 private:
  PoseSample<D> sample(std::optional<int> octave) const;

  const DeadReckoning<D>& chains_;
  const std::vector<Rigid<D>>& poses_;
  std::size_t pairs_ = 0;
  std::map<std::optional<int>, PoseSample<D>> of_octave_;
};

/// 64 bits that look drawn, from a number alone (splitmix64, Steele, Lea, Flood 2014).
inline std::uint64_t scatteredBits(std::uint64_t number) {
  std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Evenly over 0...most - 1, from `number` alone.
inline std::size_t drawIndex(std::uint64_t number, std::size_t most) { return scatteredBits(number) % most; }

extern template class PoseSample<2>;
extern template class PoseSample<3>;
extern template class ChanceDensity<2>;
extern template class ChanceDensity<3>;

}  // namespace pose_graph
