// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "robust/evidence/closure_loops.hpp"
#include "robust/evidence/variances.hpp"
#include "solve/relaxed_set.hpp"

namespace pose_graph {

/// Log Bayes factor that a set of closures needs over odometry only, and over another set, to be accepted: a factor of
/// 1000, "decisive" in Jeffreys, Theory of Probability, 1961.
constexpr double kDecisive = 7.0;

/// Variance factor below which verdicts hardly change.
constexpr double kSameFactor = 1.4;

/// A set of edges assumed to be true, with its evidence.
template <int D>
struct Hypothesis {
  std::vector<char> in;  ///< by edge: nonzero if assumed true
  std::vector<Rigid<D>> poses;
  VarianceFactors factors;
  double log_inside = 0.0;        ///< part of the evidence due to the edges inside
  double log_evidence = 0.0;      ///< total evidence
  double collapse_penalty = 0.0;  ///< HypothesisEvaluator::collapsePenalty()
};

/// Scores sets of edges of one graph by their log evidence: the density of all measurements with the poses integrated
/// out about the minimum (Laplace's approximation; MacKay, Neural Computation 1992). An edge outside has the density of
/// chance, uniform over the region that odometry can have reached and all headings; a closure outside whose neighbour
/// is also outside may have the same error, as similar places do. All sizes of sets, and all sets of a size, are
/// equally likely a priori, so that a set must explain more than its choice costs; within rows the prior counts changes
/// between true and false. If the map of a set makes agreement by chance more likely than odometry's map does, the
/// difference is subtracted from its evidence over odometry only: any closures fit a degenerate map in which distinct
/// places coincide.
template <int D>
class HypothesisEvaluator {
 public:
  HypothesisEvaluator(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

  /// Relaxes the edges inside from `hypothesis.poses`, estimates the variance factors and sets `log_evidence`. A
  /// trusted edge outside is a slip, with its prior probability.
  void evaluate(Hypothesis<D>& hypothesis) const;

  /// Returns the log Bayes factor of the estimated variance factors over the stated variances; near zero if few
  /// closures determine the factors. `by_rows`: of a hypothesis evaluated by assessRows().
  double gainByFactors(const Hypothesis<D>& hypothesis, bool by_rows = false) const;

  /// Returns the upper bound of the factor of odometry. For errors independent between steps, half of the squared
  /// difference of two successive steps bounds the variance of one, as the motion only adds to it. The bound is 100
  /// times the median, to allow for dependent errors, and at least 100.
  double largestOdometryFactor() const { return largest_odometry_; }

  /// Returns the log density of chance agreement of the closures inside on the map of the hypothesis, relative to
  /// odometry's map; it is no evidence for them. Closures are found between similar places, hence the density of a true
  /// closure is relative to the density of such relative poses on the map, averaged over the volume within which the
  /// whole set predicts the first closure of each row; later closures of a row are found because of the first. Never
  /// negative. Zero if closures are assertions: they are scored with the stated variance of odometry, which does not
  /// contract the map. Requires: evaluate().
  double collapsePenalty(const Hypothesis<D>& hypothesis) const;

  /// Returns whether most closures state the same value, such as "the same place" without a measurement. They are
  /// exactly consistent with each other, the more so the larger the variance of odometry: variances estimated from them
  /// serve to score one set, but not to find another one or to relax.
  bool areAssertions() const { return assertions_; }

  /// Returns closureRows(), by edge.
  const std::vector<int>& rows() const { return row_; }

  /// Returns the number of rows of neighbouring closures inside; closures of one row are not independent.
  double rowsInside(const Hypothesis<D>& hypothesis) const;

  /// Returns the rows inside that are the only ones to span some step between consecutive poses. No other closure
  /// confirms such a row, and without it the map returns to odometry there. At most eight, in descending order of the
  /// number of such steps.
  std::vector<std::vector<int>> unconfirmedRows(const Hypothesis<D>& hypothesis) const;

  /// Evaluates a hypothesis with one closure of each row (of up to thirty), and factors estimated with these. Over a
  /// long distance the error of odometry may exceed its stated covariance while it is smaller between closures of a
  /// row, and the large number of closures in rows conceals it. `rounds`: of the estimation; 0 keeps the factors of the
  /// hypothesis.
  Hypothesis<D> assessRows(const Hypothesis<D>& hypothesis, int rounds) const;
  static constexpr int kRounds = 10;

  /// Returns the log Bayes factors of a set evaluated by assessRows() over the same set without each of the given rows,
  /// linearised at its solution. Minus infinity if no estimate is possible: for rows of more than thirty closures, and
  /// for rows that are the only connection of parts.
  std::vector<double> estimateLosses(const Hypothesis<D>& rows, const Hypothesis<D>& hypothesis,
                                     const std::vector<std::vector<int>>& without) const;

  /// Returns whether a row inside that no other closure confirms (unconfirmedRows()) contradicts the rest of the set.
  /// Test: chi-square of its first closure at 99.9 %, divided among these rows (Bonferroni), with the variances
  /// estimated without the row, at least those stated. With variances estimated from the row itself, odometry would
  /// never contradict it.
  bool hasContradictedRow(const Hypothesis<D>& hypothesis) const;

  /// Returns the closures outside a set, by edge, of rows with more closures inside than outside.
  std::vector<char> outsideAcceptedRows(const std::vector<char>& in) const;

  /// Returns whether larger variances may yield a more likely set than an evaluated one; `edges`: its assessments.
  /// Including the nearest rows outside, of any number, raises the common variance factor at the cost of the edges
  /// inside. A row has the cost of its nearest closure at the solution, and at most the density of an exact prediction.
  bool mayFitLooser(const Hypothesis<D>& hypothesis, const std::vector<EdgeAssessment>& edges) const;

  /// Returns whether any pose differs by more than a hundredth of the map's extent.
  bool isDisplaced(const std::vector<Rigid<D>>& poses, const std::vector<Rigid<D>>& others) const;

  /// Evaluates only trusted and asserted edges. Call before any other evaluation.
  Hypothesis<D> evaluateOdometry();

 private:
  // Relaxes, estimates the factors in at most `rounds` rounds and sets `log_evidence`.
  void assess(Hypothesis<D>& hypothesis, int rounds) const;
  double chance(const Hypothesis<D>& hypothesis) const;
  // Whether a closure is more likely to have the error of the previous one in its row than to agree by chance.
  bool isFollower(int e) const {
    const std::size_t i = static_cast<std::size_t>(e);
    return neighbour_[i] >= 0 && log_alike_[i] > log_false_[i];
  }
  // Estimates both factors at the relaxed and factored set.
  VarianceFactors estimateFactors(const Hypothesis<D>& hypothesis) const;
  // Largest log likelihood ratio that a closure may have relative to chance with this variance factor.
  double mostWorth(std::size_t closure, double factor) const;
  // Log density of the closures that follow another one in their row, given the previous one.
  double followersInside(const Hypothesis<D>& hypothesis) const;

  Problem<D> problem_;  // unmeasured directions are bounded by the map; poses fixed at odometry are free
  const std::vector<EdgeRole>& roles_;
  DeadReckoning<D> reckoning_;
  std::vector<int> candidates_;
  std::unique_ptr<RelaxedSet<D>> set_;
  double largest_odometry_ = 1.0;
  bool assertions_ = false;
  double log_odometry_ = 0.0;      ///< log_inside of odometry only
  double log_place_ = 0.0;         ///< log density of one pose, uniform over the map
  std::vector<double> log_false_;  ///< by edge: log density of its measurement under chance
  std::vector<int> neighbour_;     ///< by edge: the previous closure of its row; -1 if none
  /// By edge: log density of its measurement with the error of its neighbour; minus infinity at the limit of a row's
  /// length.
  std::vector<double> log_alike_;
  std::vector<int> row_;
};

extern template class HypothesisEvaluator<2>;
extern template class HypothesisEvaluator<3>;

}  // namespace pose_graph
