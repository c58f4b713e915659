// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "robust/evidence/dead_reckoning.hpp"

namespace pose_graph {

/// The loop over two closures and the odometry between their ends. It ends where it began if both closures are true
/// (Olson, Walter, Leonard, Teller, Single-cluster graph partitioning for robotics applications, RSS 2005).
struct ClosureLoop {
  double chi2 = 0.0;       ///< of the loop error, with all covariances as stated
  double log_true = 0.0;   ///< log density of a zero loop error if both are true
  double log_false = 0.0;  ///< log density of any loop error if one of them is uniform over the map
};

/// Closures sorted by their ends, for enumeration of near pairs.
template <int D>
class ClosureLoops {
 public:
  /// `problem` and `chains` must outlive this object.
  ClosureLoops(const Problem<D>& problem, const std::vector<int>& candidates, const DeadReckoning<D>& chains);

  std::size_t size() const { return closures_.size(); }
  int edge(std::size_t i) const { return closures_[i].edge; }
  double extent() const { return chains_->extent; }
  /// Cost: linear in the number of poses between the ends.
  ClosureLoop loop(std::size_t a, std::size_t b) const;

  /// Returns the next closure after `a` in its row, or size(). Both ends are at most kRowReach poses from those of `a`,
  /// or odometry between them is more accurate than the two closures, which are then consistent in any case.
  std::size_t nextInRow(std::size_t a) const;
  /// Returns the path length between the ends of two closures, m; the larger one of the two sides.
  double metresBetween(std::size_t a, std::size_t b) const;

  /// Calls visit(b) for at most `most` closures after `a` whose ends are both at most kRowReach poses from those of
  /// `a`; between two chains, at any distance, because no odometry relates them.
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
  struct Closure {  // ends in ascending order
    int edge = 0, from = 0, to = 0;
    Rigid<D> Z;
    TangentMatrix<D> covariance;       // in the frame of `from`
    double variances[2] = {0.0, 0.0};  // trace for translation and rotation
  };
  static Closure toClosure(const Problem<D>& problem, int edge, double extent);
  std::pair<int, int> closureChains(const Closure& c) const {
    return {chains_->of_pose[static_cast<std::size_t>(c.from)], chains_->of_pose[static_cast<std::size_t>(c.to)]};
  }

  // Returns the variance of the steps between two poses in translation (0) or rotation (1), summed over axes.
  double stepVariance(int from, int to, int kind) const {
    return std::abs(steps_[kind][static_cast<std::size_t>(to)] - steps_[kind][static_cast<std::size_t>(from)]);
  }

  const DeadReckoning<D>* chains_;
  std::vector<Closure> closures_;
  std::vector<double> steps_[2];  // cumulative variances of the steps up to each pose
};

/// Variance factor of false closures in a row: they have similar errors and nearly agree. Loops with at least five
/// times the deviation of true ones are attributed to them.
constexpr double kLooseFactor = 25.0;
/// Number of loops that determines the scale of errors: in two dimensions the sum of squares is then accurate to a
/// sixth (the deviation of a chi-square with 90 degrees of freedom).
constexpr double kTellingLoops = 30.0;

/// Scale of the information matrices, estimated from loops of near closures before the graph is relaxed. The
/// chi-squares are a mixture: of true pairs, distributed as chi-square times `factor`, and of false ones, which are
/// uniform or, in a row, have similar errors. The mixture is fitted by expectation-maximisation (Dempster, Laird, Rubin
/// 1977).
struct InformationScale {
  /// Ratio of the actual variances to those stated by the information. 1 without loops; a few loops change it only a
  /// little.
  double factor = 1.0;
  double true_loops = 0.0;  ///< number among the evaluated loops
  double true_share = 0.0;
};
template <int D>
InformationScale informationScale(const ClosureLoops<D>& loops);

/// Finds rows of closures. The closures of a row may all result from one pair of similar places. Returns for each of
/// `edges` edges one representative closure of its row, -1 for edges that are not candidates. A row longer than the map
/// is wide is split, because similar places are parts of the map.
template <int D>
std::vector<int> closureRows(const ClosureLoops<D>& closures, std::size_t edges);

/// Thresholds for the tests of closures.
struct Thresholds {
  /// Probability that any true closure of the whole graph fails its test (Bonferroni correction).
  static constexpr double kFalseAlarms = 0.05;
  /// Minimum log likelihood ratio of a closure relative to chance, log(500): of false closures at plausible poses, one
  /// in 500 would pass.
  static constexpr double kEvidence = 6.214608098422191;
  /// Probability of a set of links that agree by chance, and of a true residual beyond its limit in the final test.
  static constexpr double kChance = 0.01;
  /// Share of closures considered negligible, and share above which a selection is contested: Baarda's test detects
  /// single outliers among many correct observations, and fails with many outliers.
  static constexpr double kNegligible = 1e-3, kContested = 0.02;
  /// Minimum number of consistent closures: a single one neither proves nor contradicts anything.
  static constexpr std::size_t kLeastAgreeing = 2;

  std::vector<double> limit;  ///< limit of chi-square, by degrees of freedom
  /// Minimum evidence in the early rounds: if all candidates were false, one would pass with probability kFalseAlarms.
  /// Closures admitted early influence all later tests.
  double early_evidence = 0.0;

  Thresholds(std::size_t candidates, int largest_dof);
};

/// Finds groups of mutually consistent closures: near ones whose loop closes, with the evidence required by
/// `thresholds` (Latif, Cadena, Neira, RRR, RSS 2012). `variance`: factor of all covariances.
///
/// Returns for each of `edges` edges the number of its group (the first edge of the group), -1 for edges that are not
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
