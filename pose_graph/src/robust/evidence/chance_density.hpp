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

/// Number of pairs of poses in a density estimate: 16 neighbours of 8192 resolve a share of 1/512.
constexpr std::size_t kMostPairs = 8192;

/// Density of relative poses in a sample, estimated from the distance to the nearest 16 samples (Loftsgaarden,
/// Quesenberry, A nonparametric estimate of a multivariate density function, 1965).
template <int D>
class PoseSample {
 public:
  PoseSample() = default;
  /// `extent`: of the map, m. `ends`: numbers of the two poses of each sample, or empty.
  PoseSample(std::vector<Rigid<D>> poses, double extent, std::vector<std::pair<int, int>> ends = {});

  /// Sampled pairs to exclude: both ends within `reach` poses of `from` and `to`.
  struct Own {
    int from = 0, to = 0, reach = -1;
  };

  /// Returns the log density per metre^D and radian^(directions of rotation), averaged over at least `volume` in these
  /// units (what the measurement resolves), without the excluded pairs. A tenth of the density is uniform over the
  /// extent, because the sample is incomplete.
  double logDensity(const Rigid<D>& at, double volume = 0.0, const Own& own = {}) const;

 private:
  // Number of samples excluded by `own`.
  std::size_t count(const Own& own) const;

  std::vector<Rigid<D>> poses_;                      // in the order of axis_
  std::vector<std::pair<int, int>> ends_, by_ends_;  // of each sample; sorted
  Eigen::Index axis_ = 0;                            // axis of the widest spread
  double shift_ = 1.0, turn_ = 1.0;                  // root mean squares of one coordinate, m and rad
  double even_ = 1.0;
};

/// Density of chance agreement: how likely two unrelated poses of a map are related as a closure measures. It is
/// estimated from the map itself, over pairs of poses about as far apart in number as the closure's. A map with streets
/// in two directions has four times as many parallel pairs as uniform headings, and nearby places on a curved path have
/// similar headings. For a closure between two chains, whose frames are unrelated, pairs at all distances are used.
template <int D>
class ChanceDensity {
 public:
  /// Uses the map of dead reckoning. `closures`: number of queries expected; for many, fewer pairs are sampled.
  ChanceDensity(const DeadReckoning<D>& chains, std::size_t closures) : ChanceDensity(chains, chains.pose, closures) {}
  /// Uses the map given by `poses`, with the same pairs. Both arguments must outlive this object.
  ChanceDensity(const DeadReckoning<D>& chains, const std::vector<Rigid<D>>& poses, std::size_t closures);

  /// Returns PoseSample::logDensity() at the measurement of an edge, over its resolution and at least `volume`.
  double logAt(const Edge<D>& edge, double volume = 0.0);

 private:
  PoseSample<D> sample(std::optional<int> octave) const;

  const DeadReckoning<D>& chains_;
  const std::vector<Rigid<D>>& poses_;
  std::size_t pairs_ = 0;
  std::map<std::optional<int>, PoseSample<D>> of_octave_;
};

/// Returns 64 pseudorandom bits as a function of a number (splitmix64, Steele, Lea, Flood 2014).
inline std::uint64_t scatteredBits(std::uint64_t number) {
  std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Returns a uniform index in 0...most - 1 as a function of `number`.
inline std::size_t drawIndex(std::uint64_t number, std::size_t most) { return scatteredBits(number) % most; }

extern template class PoseSample<2>;
extern template class PoseSample<3>;
extern template class ChanceDensity<2>;
extern template class ChanceDensity<3>;

}  // namespace pose_graph
