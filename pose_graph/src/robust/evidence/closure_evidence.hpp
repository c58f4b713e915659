// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "objective/whitened_edge.hpp"
#include "robust/evidence/dead_reckoning.hpp"
#include "solve/accepted_graph.hpp"

namespace pose_graph {

/// Test statistics of all candidates with respect to the accepted graph; indexed by edge of the whole problem.
struct Evidence {
  /// Chi-square of the edge with respect to all other accepted edges, with `rank` degrees of freedom: of its innovation
  /// if it is outside, of its innovation without itself if it is inside. Infinite if its ends are not connected.
  std::vector<double> chi2;
  /// Edges inside: chi-square of one bias common to the group, with the tangent's degrees of freedom; 0 without a
  /// group.
  std::vector<double> group_chi2;
  /// Log likelihood ratio of the residual: true closure against a uniformly distributed one.
  std::vector<double> likelier;
  std::vector<double> group_likelier;  ///< as `likelier`, of the group's bias; 0 without a group
  double variance = 1.0;               ///< variance factor used in the evaluation
  bool known = true;                   ///< false: the accepted graph could not be factored; all other members are unset
};

/// The whitened candidates of a problem and the constants of their tests.
template <int D>
class ClosureEvaluator {
 public:
  /// Number of random disturbances. A covariance from 24 samples has an error of 30 %; its inverse is too large by 24 /
  /// (23 - N) and is corrected. Chosen for speed; larger numbers were not compared.
  static constexpr int kDisturbances = 24;

  ClosureEvaluator(const Problem<D>& problem, const std::vector<int>& candidates, const DeadReckoning<D>& chains);

  const WhitenedEdge<D>& edge(int e) const { return edges_[static_cast<std::size_t>(e)]; }
  const std::vector<int>& candidates() const { return candidates_; }

  /// Evaluates all candidates. Random disturbances of one standard deviation (kDisturbances sign vectors) on all
  /// accepted edges are propagated through the factor of `graph`. Their sample covariance at an edge is that of its
  /// residual (inside) or of its prediction (outside), to 30 %.
  /// `variance`: factor of all covariances. `small_group`: group of each edge, -1 for none, for the test of a common
  /// bias. `uncontrolled`: redundancy below which a residual carries no information (kUncontrolled in admission.hpp).
  /// `own`: additional variance factor of the tested closure or group only.
  Evidence evaluate(AcceptedGraph<D>& graph, const std::vector<char>& in, const std::vector<Rigid<D>>& poses,
                    double variance, const std::vector<int>& small_group, double uncontrolled, double own = 1.0) const;

 private:
  using Samples = Eigen::Matrix<double, kTangentSize<D>, kDisturbances, Eigen::RowMajor>;

  std::vector<WhitenedJacobians<D>> linearise(const std::vector<char>& in, const std::vector<Rigid<D>>& poses) const;
  // Response of each candidate to the disturbances: of its residual if inside, of its prediction if outside.
  std::vector<Samples> disturb(AcceptedGraph<D>& graph, const std::vector<char>& in,
                               const std::vector<WhitenedJacobians<D>>& at) const;
  void evaluateOne(std::size_t k, bool inside, const WhitenedJacobians<D>& at, const Samples& moved,
                   double uncontrolled, double own, Evidence& made) const;
  void evaluateGroup(const std::vector<std::size_t>& members, const std::vector<Rigid<D>>& poses,
                     const std::vector<WhitenedJacobians<D>>& at, const std::vector<Samples>& moved,
                     double uncontrolled, double own, Evidence& made) const;

  const Problem<D>* problem_;
  std::vector<int> candidates_;
  std::vector<WhitenedEdge<D>> edges_;
  std::vector<double> width_log_;  ///< minus the log density of false poses (m, rad); by candidate
  std::vector<double> false_log_;  ///< minus the log density of false residuals, whitened; by candidate
};

/// Returns the log density of the residual of a true closure. If `variance`, the factor of all covariances estimated
/// from residuals, is below 1, most residuals are normal with that factor and one in twenty is normal with the stated
/// covariance: a contaminated normal distribution (Tukey, A survey of sampling from contaminated distributions, 1960)
/// whose wider part is not a parameter but the stated covariance. Otherwise normal with that factor.
///
/// `log_at_zero`: log density of a zero residual with stated covariances. `chi2`: with stated covariances and `rank`
/// degrees of freedom.
double logInlierLikelihood(double log_at_zero, int rank, double chi2, double variance);

extern template class ClosureEvaluator<2>;
extern template class ClosureEvaluator<3>;

}  // namespace pose_graph
