// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "linear/index.hpp"
#include "objective/whitened_edge.hpp"
#include "robust/evidence/closure_evidence.hpp"
#include "robust/evidence/closure_loops.hpp"
#include "solve/accepted_graph.hpp"

namespace pose_graph {

/// Accepted edges, their relaxed poses, and the evidence for the candidates.
template <int D>
struct AdmissionState {
  std::vector<char> in;
  std::vector<Rigid<D>> poses;
  Evidence evidence;
  double variance = 1.0;      ///< RobustSolution::variance_factor
  bool is_too_dense = false;  ///< aborted: factoring the accepted edges exceeds the work limit
};

/// Admits and removes closures in rounds, by evidence (pose_graph/robust.hpp). Aborts if AcceptedGraph::work() exceeds
/// `most_work`.
template <int D>
AdmissionState<D> admitClosures(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                const ClosureEvaluator<D>& evaluator, const std::vector<int>& group,
                                const Thresholds& thresholds, const InformationScale& scale, double most_work);

/// Accepts all candidates in `state` and `graph` if almost none is contradicted then. This completes the selection for
/// a graph with no or almost no false closures. Returns whether all were accepted. `state`: on entry, the evidence from
/// the graph without candidates. `small_group` as in ClosureEvaluator::evaluate().
template <int D>
bool admitAll(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group, const std::vector<int>& small_group,
              const Thresholds& thresholds, const InformationScale& scale, AcceptedGraph<D>& graph,
              AdmissionState<D>& state);

/// Tries one self-consistent group that contradicts the current graph, since errors of odometry over a long path lie on
/// an arc, which linearised covariances do not represent. The group is accepted if the cost of the graph relaxed with
/// it rises by no more than chance explains for all its members, or if few other closures have to leave for it and all
/// remaining ones fit (a false closure may exclude many true ones). `tried`: groups not to be tried again. Returns
/// whether a group was accepted.
template <int D>
bool admitOneGroup(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group, const Thresholds& thresholds,
                   std::set<int>& tried, AcceptedGraph<D>& graph, AdmissionState<D>& state);

/// Tests all closures at the converged solution, which reveals closures that almost nothing controls, such as a group
/// over a long path that bends the graph until it fits. Outliers are removed; a group is removed only if it raises the
/// cost by more than chance explains. If none is removed, likely closures are admitted. Returns the number of changes.
/// `expelled`: number of removals per edge.
template <int D>
std::size_t validateFinally(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group,
                            const std::vector<int>& small_group, const Thresholds& thresholds,
                            const InformationScale& scale, std::vector<int>& expelled, AcceptedGraph<D>& graph,
                            AdmissionState<D>& state);

/// Continues with all candidates under truncated least squares; the limit decreases from a wide one to the 99 %
/// quantile. Keeps the result if its truncated cost is lower. Runs only if many rejected closures are close to the
/// graph; aborts if the work to factor exceeds `most_work`.
template <int D>
void readmitByTruncatedSquares(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const ClosureEvaluator<D>& evaluator, double most_work, AdmissionState<D>& state);

/// Limits of a round's relaxation: steps, and remaining share of the cost. Residuals then change by less than a tenth
/// of their noise.
constexpr int kRoundSteps = 8;
constexpr double kRoundShare = 0.01;

/// Redundancy below which an edge is not controlled by the others: less than this share of its error appears in its
/// residual, and the remaining error of a round's relaxation would be mistaken for it. At the converged solution
/// (AcceptedGraph::settle) a redundancy of 1e-6 is usable: a closure of 1 cm against an odometry error of 10 m.
/// kSettled is also the final share of the cost in relaxations that decide on a group, which resolves about 1 in
/// chi-square.
constexpr double kUncontrolled = 0.1, kSettled = 1e-6;

/// Share of the candidates that counts as many.
constexpr double kMany = 0.05;

/// Factor of the limit for removal. A chi-square from 24 samples has a relative deviation of the root of 2 / 24 = 0.29;
/// removal requires two such deviations.
inline double sampledMargin() { return 1.0 + 2.0 * std::sqrt(2.0 / ClosureEvaluator<2>::kDisturbances); }

/// Limit of the work relative to that of factoring the mutually confirmed closures. Above it, the other closures are
/// false, or so many of them are that a trial of all is not worthwhile.
constexpr double kWork = 4.0;

/// Returns the largest chi-square of an edge that chance explains.
template <int D>
double findLimit(const Thresholds& thresholds, const WhitenedEdge<D>& edge) {
  return thresholds.limit[static_cast<std::size_t>(std::max(1, edge.rank))];
}

/// Returns the chi-square above which an accepted edge is removed. `worst`: the largest one of all accepted edges.
/// Large outliers are removed first, because they distort the others.
inline double leavesBeyond(const Thresholds& thresholds, double limit, double worst) {
  return std::max(sampledMargin() * limit, std::sqrt(thresholds.limit.back() * worst));
}

/// One round of admission. `in` holds the accepted edges, `next` those after the round.
template <int D>
class AdmissionRound {
 public:
  /// All arguments must outlive this object.
  AdmissionRound(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group, const Thresholds& thresholds,
                 const Evidence& evidence, const std::vector<char>& in)
      : next(in), evaluator_(evaluator), group_(group), thresholds_(thresholds), evidence_(evidence), in_(in) {}

  // `times`: number of removals per edge; an edge removed twice is not readmitted.

  /// Removes accepted edges that chance does not explain. If the information is too low, an edge with evidence stays if
  /// its stated covariance explains its residual.
  void expel(std::vector<int>& times);
  /// Admits rejected edges that fit and have the evidence `least`: the better half, or all if they are fewer than the
  /// accepted ones.
  void admit(const std::vector<int>& times, double least);
  /// Admits rejected edges that fit; among many true closures, less evidence is required.
  void admitLikely(const std::vector<int>& times);
  /// Admits the largest self-consistent groups that fit as a whole, for odometry too uncertain for single evidence.
  void admitGroups(const std::vector<int>& times);
  /// Joins two unconnected parts by the largest group of at least two closures between them.
  void join(const AcceptedGraph<D>& graph, const std::vector<int>& times);

  std::vector<char> next;
  std::size_t changes = 0, admitted = 0;
  bool joined = false;

 private:
  double limit(int e) const { return findLimit(thresholds_, evaluator_.edge(e)); }
  double asStated() const { return std::min(1.0, evidence_.variance); }
  bool outAndFits(int e) const { return !in_[sz(e)] && evidence_.chi2[sz(e)] * asStated() <= limit(e); }
  bool excused(int e, double off) const;
  void let(int e);

  const ClosureEvaluator<D>& evaluator_;
  const std::vector<int>& group_;
  const Thresholds& thresholds_;
  const Evidence& evidence_;
  const std::vector<char>& in_;
};

extern template class AdmissionRound<2>;
extern template class AdmissionRound<3>;

}  // namespace pose_graph
