// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "robust/evidence/dead_reckoning.hpp"

namespace pose_graph {

/// Two closures and the odometry between their ends. The path from one pose along odometry to the next, over one
/// closure, along odometry again and back over the other closure ends where it began if both are true (Olson, Walter,
/// Leonard, Teller, Single-cluster graph partitioning for robotics applications, RSS 2005).
struct ClosureLoop {
  double chi2 = 0.0;       ///< of the tangent that remains, with all covariances as stated
  double log_true = 0.0;   ///< logarithm of the density of no remainder at all, were both true
  double log_false = 0.0;  ///< of any remainder, were one of them anywhere
};

/// Closures in the order of their ends, for pairs of near ones.
template <int D>
class ClosureLoops {
 public:
  /// `problem` and `chains` must outlive it.
  ClosureLoops(const Problem<D>& problem, const std::vector<int>& candidates, const DeadReckoning<D>& chains);

  std::size_t size() const { return closures_.size(); }
  int edge(std::size_t i) const { return closures_[i].edge; }
  double extent() const { return chains_->extent; }
  /// Costs the number of poses between the ends.
  ClosureLoop loop(std::size_t a, std::size_t b) const;

  /// Returns the closure after `a` in its row, size() for none: both ends are at most kRowReach poses from its own, or
  /// so near that odometry between them is known better than the two closures, which then agree in any case.
  std::size_t nextInRow(std::size_t a) const;
  /// Metres of the drive between the ends of two closures, on the side where they are more.
  double metresBetween(std::size_t a, std::size_t b) const;

  /// visit(b) for the closures after `a` that are near it, at most `most`: both ends at most kRowReach poses apart;
  /// between two chains, which nothing else can vouch for, however far apart.
  template <typename Visit>
  void partners(std::size_t a, int most, const Visit& visit) const {
    const auto on = closureChains(closures_[a]);
    const bool between = on.first != on.second;
    for (std::size_t b = a + 1; b < closures_.size() && most > 0; ++b) {
      if (closureChains(closures_[b]) != on || (!between && closures_[b].from > closures_[a].from + kRowReach)) return;
      if (!between && std::abs(closures_[b].to - closures_[a].to) > kRowReach) continue;
      --most;
      visit(b);
    }
  }

 private:
  struct Closure {  // its ends in the order of their numbers
    int edge = 0, from = 0, to = 0;
    Rigid<D> Z;
    TangentMatrix<D> covariance;       // in the frame of `from`
    double variances[2] = {0.0, 0.0};  // translation and rotation, all axes together
  };
  static Closure toClosure(const Problem<D>& problem, int edge, double extent);
  std::pair<int, int> closureChains(const Closure& c) const {
    return {chains_->of_pose[static_cast<std::size_t>(c.from)], chains_->of_pose[static_cast<std::size_t>(c.to)]};
  }

  // Variance of the steps between two poses in translation (0) or rotation (1), all axes together.
  double stepVariance(int from, int to, int kind) const {
    return std::abs(steps_[kind][static_cast<std::size_t>(to)] - steps_[kind][static_cast<std::size_t>(from)]);
  }

  const DeadReckoning<D>* chains_;
  std::vector<Closure> closures_;
  std::vector<double> steps_[2];  // sums of the variances of all steps up to each pose
};

/// Of variances: false closures that were found in a row err alike, and nearly agree. Loops whose deviations are at
/// least five times those of true ones are taken for theirs.
constexpr double kLooseFactor = 25.0;
/// So many loops tell how large errors are: their sum of squares is good to a sixth in two dimensions (the deviation of
/// a chi-square of 90 degrees of freedom).
constexpr double kTellingLoops = 30.0;

/// What loops of near closures say of a graph before anything is known of its shape. Their chi-squares come from true
/// pairs, where they follow their distribution times `factor`, and from false ones, which are anywhere or, found in a
/// row, err alike; the likeliest mixture of these is found by expectation and maximisation (Dempster, Laird, Rubin
/// 1977).
struct InformationScale {
  /// By what the variances differ from those that the information states. Without loops 1; few draw it from there but
  /// little.
  double factor = 1.0;
  double true_loops = 0.0;  ///< of those looked at
  double true_share = 0.0;
};
template <int D>
InformationScale informationScale(const ClosureLoops<D>& loops);

/// Rows of closures, each of which may be one place that resembles another one. Returns for each of so many edges one
/// closure of its row, -1 for edges that are no candidates. A row longer than the map is wide is several: similar
/// places are parts of the map.
template <int D>
std::vector<int> closureRows(const ClosureLoops<D>& closures, std::size_t edges);

/// What tells a true closure's residual from a false one's, in numbers.
struct Thresholds {
  /// The chance that any true closure of the whole graph fails its test (Bonferroni: shared by all).
  static constexpr double kFalseAlarms = 0.05;
  /// Logarithm of how much likelier than chance a closure must be, log(500): of false ones that fall where a true one
  /// could be, one in 500 would pass.
  static constexpr double kEvidence = 6.214608098422191;
  /// Chance of a set of links that agree by chance, and of a true residual outside its limit in the end.
  static constexpr double kChance = 0.01;
  /// Share of the closures that is next to none, and the one beyond which a selection is contested: Baarda's test finds
  /// single outliers among many right ones, and starts from the wrong side there.
  static constexpr double kNegligible = 1e-3, kContested = 0.02;
  /// Closures that agree: one alone neither proves nor contradicts anything.
  static constexpr std::size_t kLeastAgreeing = 2;

  std::vector<double> limit;  ///< of chi-square, by degrees of freedom
  /// The same while the graph is still vague: of all candidates together, were all false, one would pass with the
  /// chance kFalseAlarms. What enters then shapes all that follows.
  double early_evidence = 0.0;

  Thresholds(std::size_t candidates, int largest_dof);
};

/// Groups of closures that support each other: near ones whose loop closes, with evidence as in Thresholds (Latif,
/// Cadena, Neira, RRR, RSS 2012). `variance`: factor of all covariances.
///
/// Returns for each of so many edges the number of its group (the first edge of the group), -1 for edges that are no
/// candidates.
template <int D>
std::vector<int> consistentGroups(std::size_t edges, const ClosureLoops<D>& closures, double variance,
                                  const Thresholds& thresholds);

extern template class ClosureLoops<2>;
extern template class ClosureLoops<3>;
extern template std::vector<int> closureRows<2>(const ClosureLoops<2>&, std::size_t);
extern template std::vector<int> closureRows<3>(const ClosureLoops<3>&, std::size_t);
extern template InformationScale informationScale<2>(const ClosureLoops<2>&);
extern template InformationScale informationScale<3>(const ClosureLoops<3>&);

}  // namespace pose_graph
