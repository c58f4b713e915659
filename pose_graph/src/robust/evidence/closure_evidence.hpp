// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "objective/whitened_edge.hpp"
#include "robust/evidence/dead_reckoning.hpp"
#include "solve/accepted_graph.hpp"

namespace pose_graph {

/// What the accepted graph says of each candidate; all by edge of the whole problem.
struct Evidence {
  /// Chi-square of the edge against all other accepted edges together, with `rank` degrees of freedom: of one outside
  /// its innovation, of one inside the same without itself. Infinite where an end hangs in the air.
  std::vector<double> chi2;
  /// Of one inside: chi-square, of a tangent's degrees of freedom, of one bias common to its group; 0 without a group.
  std::vector<double> group_chi2;
  /// Logarithm of how much likelier the residual is from a true closure than from one anywhere.
  std::vector<double> likelier;
  std::vector<double> group_likelier;  ///< the same of a group's bias; 0 without a group
  double variance = 1.0;               ///< as they were evaluated with
  bool known = true;  ///< false where the accepted graph could not be factored: nothing else is filled then
};

/// The candidates of a problem, whitened, with what their tests need that does not change.
template <int D>
class ClosureEvaluator {
 public:
  /// A covariance from 24 samples is good to three tenths, and inverted too large by 24 / (23 - N), which is taken off.
  /// Chosen for its time; whether more would decide better is not measured.
  static constexpr int kDisturbances = 24;

  ClosureEvaluator(const Problem<D>& problem, const std::vector<int>& candidates, const DeadReckoning<D>& chains);

  const WhitenedEdge<D>& edge(int e) const { return edges_[static_cast<std::size_t>(e)]; }
  const std::vector<int>& candidates() const { return candidates_; }

  /// Puts random disturbances of one standard deviation on all accepted edges, each by kDisturbances signs, and carries
  /// them through the factor of `graph`: the spread of what comes out at an edge is its covariance (of a residual
  /// inside, of a prediction outside), to about three tenths. `variance`: factor of all covariances. `small_group`:
  /// groups by edge, -1 for none, as they are tested for a common bias. `uncontrolled`: redundancy below which a
  /// residual tells nothing (admission_thresholds.hpp). `own`: factor of the variances of the closure or the group in
  /// question alone, all others as they are.
  Evidence evaluate(AcceptedGraph<D>& graph, const std::vector<char>& in, const std::vector<Rigid<D>>& poses,
                    double variance, const std::vector<int>& small_group, double uncontrolled, double own = 1.0) const;

 private:
  using Samples = Eigen::Matrix<double, kTangentSize<D>, kDisturbances, Eigen::RowMajor>;

  std::vector<WhitenedJacobians<D>> linearise(const std::vector<char>& in, const std::vector<Rigid<D>>& poses) const;
  // What the disturbances do to each candidate: to its residual if inside, to its prediction if outside.
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
  std::vector<double> width_log_;  ///< minus the logarithm of the density of false places (m, rad); by candidate
  std::vector<double> false_log_;  ///< minus the logarithm of the density of false residuals, whitened; by candidate
};

/// Logarithm of the density of a true closure's residual. Where information is too modest (`variance`, the factor of
/// all covariances that the residuals show, is below 1) most residuals are normal with that factor, and one in twenty
/// is as the information states: a contaminated normal distribution (Tukey, A survey of sampling from contaminated
/// distributions, 1960), whose wider part is not chosen but said by who measured. Where it boasts, normal with that
/// factor.
///
/// `log_at_zero`: logarithm of the density at no residual at all, covariances as stated. `chi2`: as stated, with `rank`
/// degrees of freedom.
double logInlierLikelihood(double log_at_zero, int rank, double chi2, double variance);

extern template class ClosureEvaluator<2>;
extern template class ClosureEvaluator<3>;

}  // namespace pose_graph
