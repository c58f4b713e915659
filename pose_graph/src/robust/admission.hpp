// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <vector>

#include "robust/consistent_groups.hpp"
#include "robust/evidence.hpp"
#include "robust/information_scale.hpp"

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

/// Judges all once more where the graph is settled, so that what hardly anything controls shows too: a group over a
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

}  // namespace pose_graph
