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

/// Which edges are in, where they put the poses, and the evidence for the candidates.
template <int D>
struct AdmissionState {
  std::vector<char> in;
  std::vector<Rigid<D>> poses;
  Evidence evidence;
  double variance = 1.0;      ///< RobustSolution::variance_factor
  bool is_too_dense = false;  ///< given up: what was in took more than the most work to factor
};

/// Lets closures into the graph by evidence, and out again (pose_graph/robust.hpp). `most_work`: of
/// AcceptedGraph::work(), beyond which it gives up.
template <int D>
AdmissionState<D> admitClosures(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                const ClosureEvaluator<D>& evaluator, const std::vector<int>& group,
                                const Thresholds& thresholds, const InformationScale& scale, double most_work);

/// Takes all candidates at once, into `state` and `graph`, if hardly any of them is contradicted then: for a graph
/// without false closures, or with next to none, that is all there is to do. Returns whether it did. `state` holds
/// what the graph without any candidate says of them; `small_group` as in ClosureEvaluator::evaluate().
template <int D>
bool admitAll(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group, const std::vector<int>& small_group,
              const Thresholds& thresholds, const InformationScale& scale, AcceptedGraph<D>& graph,
              AdmissionState<D>& state);

/// Takes one group that supports itself and does not fit where the graph stands, if it fits where it would put the
/// graph: over a long way odometry's errors lie on an arc, which linearised covariances do not see. Relaxed with the
/// group, the graph's cost may rise by as much as chance explains for all of its members together; or few others leave,
/// a false one that stands in the way of many true ones, and all that remain fit. `tried`: groups that are not worth
/// another try.
template <int D>
bool admitOneGroup(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group, const Thresholds& thresholds,
                   std::set<int>& tried, AcceptedGraph<D>& graph, AdmissionState<D>& state);

/// Tests all once more where the graph is settled, so that what hardly anything controls shows too: a group over a
/// long way that bends the graph until it fits. What is far off leaves, a group only if the graph costs more with it
/// than chance explains; where none leaves, what is likely enters. Returns how many changed. `expelled`: times each
/// edge has left.
template <int D>
std::size_t validateFinally(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group,
                            const std::vector<int>& small_group, const Thresholds& thresholds,
                            const InformationScale& scale, std::vector<int>& expelled, AcceptedGraph<D>& graph,
                            AdmissionState<D>& state);

/// Continues from there with all candidates, their squares truncated, the limit falling from far too wide to the
/// quantile of 99 %; keeps the result if its truncated cost is lower. Worth its time only where many are out that are
/// not far off; given up where it takes more than `most_work` to factor.
template <int D>
void readmitByTruncatedSquares(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const ClosureEvaluator<D>& evaluator, double most_work, AdmissionState<D>& state);

/// A round's relaxation: steps at most, and the share of the cost that is left. Residuals then move by less than a
/// tenth of their noise.
constexpr int kRoundSteps = 8;
constexpr double kRoundShare = 0.01;

/// Redundancy below which an edge is not controlled by the others: less of its error than that shows in its residual,
/// and what a round's relaxation leaves would be taken for it. Where the graph is settled (AcceptedGraph::settle) a
/// millionth is seen: a closure of a centimetre beside ten metres of odometry's error. A
/// relaxation that decides on one group ends at that share of the cost, which is good to a number or so.
constexpr double kUncontrolled = 0.1, kSettled = 1e-6;

/// Share of the candidates that is many.
constexpr double kMany = 0.05;

/// Times the limit: a chi-square from so many samples is good to the root of 2 over their number, 0.29 of its value for
/// 24, and what leaves is off by two deviations of that.
inline double sampledMargin() { return 1.0 + 2.0 * std::sqrt(2.0 / ClosureEvaluator<2>::kDisturbances); }

/// Times the work of factoring the closures that another one confirms: beyond, the others are false, or so many of them
/// that all together are not worth a trial.
constexpr double kWork = 4.0;

/// Chi-square of an edge that may stand by chance.
template <int D>
double findLimit(const Thresholds& thresholds, const WhitenedEdge<D>& edge) {
  return thresholds.limit[static_cast<std::size_t>(std::max(1, edge.rank))];
}

/// Chi-square from which an edge inside has to leave, where `worst` is the largest of all inside: far off ones first,
/// as they spoil the others.
inline double leavesBeyond(const Thresholds& thresholds, double limit, double worst) {
  return std::max(sampledMargin() * limit, std::sqrt(thresholds.limit.back() * worst));
}

/// A round of admission: which closures enter and which leave, by the evidence. `in` says what is inside, `next` what
/// will be.
template <int D>
class AdmissionRound {
 public:
  /// All must outlive it.
  AdmissionRound(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group, const Thresholds& thresholds,
                 const Evidence& evidence, const std::vector<char>& in)
      : next(in), evaluator_(evaluator), group_(group), thresholds_(thresholds), evidence_(evidence), in_(in) {}

  // `times`: how often each edge has left so far; who left twice stays out.

  /// In, and more than chance can explain. Where information is too modest that is not enough: what it states explains
  /// the residual of one that there is evidence for.
  void expel(std::vector<int>& times);
  /// Out, fits, and has evidence: the better half, or all once they are fewer than those inside.
  void admit(const std::vector<int>& times, double least);
  /// Out, fits, and has evidence, where among many that are right one more is likely to be.
  void admitLikely(const std::vector<int>& times);
  /// Where odometry is too vague for evidence: the largest groups that support each other and fit as a whole.
  void admitGroups(const std::vector<int>& times);
  /// Two parts that nothing joins: the largest group between them, if there are two.
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
