// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include "linear/index.hpp"
#include "robust/admission.hpp"
#include "robust/admission_round.hpp"
#include "robust/variance_factor.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace pose_graph {

namespace {

// Whether the settled graph costs no more with a group than chance explains for all its members together: where it
// closes a long way its linearised test sees a straight line, and finds true ones too far off.
template <int D>
bool stands(const ClosureEvaluator<D>& evaluator, const Thresholds& thresholds, const std::vector<int>& members,
            AcceptedGraph<D>& graph, const AdmissionState<D>& state, double cost) {
  std::vector<char> in = state.in;
  int dof = 0;
  for (int e : members) {
    in[sz(e)] = 0;
    dof += evaluator.edge(e).rank;
  }
  std::vector<Rigid<D>> poses = state.poses;
  graph.take(in);
  graph.settle(poses);
  const double rise = (cost - graph.cost(poses)) / state.variance;
  return rise <= urban_nav_core::chiSquareQuantile(1.0 - thresholds.kFalseAlarms / kTries, dof);
}

// Groups that would leave and that an arc may explain stay if they stand.
template <int D>
void reprieve(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group, const Thresholds& thresholds,
              const AdmissionState<D>& state, AcceptedGraph<D>& graph, AdmissionRound<D>& round,
              std::vector<int>& expelled) {
  std::map<int, std::vector<int>> members, leaving;
  for (int e : evaluator.candidates()) {
    if (!state.in[sz(e)]) continue;
    members[group[sz(e)]].push_back(e);
    const double off = state.evidence.group_chi2[sz(e)];
    if (!round.next[sz(e)] && off > 0.0 && off <= kArc * thresholds.limit.back()) leaving[group[sz(e)]].push_back(e);
  }
  const double cost = graph.cost(state.poses);
  std::size_t tries = 0;
  for (const auto& [name, some] : leaving) {
    if (++tries > kTries) break;
    if (!stands(evaluator, thresholds, members[name], graph, state, cost)) continue;
    for (int e : some) {
      round.next[sz(e)] = 1;
      --expelled[sz(e)];
      --round.changes;
    }
  }
  graph.take(state.in);
}

}  // namespace

template <int D>
std::size_t validateFinally(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group,
                            const std::vector<int>& small_group, const Thresholds& thresholds,
                            const InformationScale& scale, std::vector<int>& expelled, AcceptedGraph<D>& graph,
                            AdmissionState<D>& state) {
  graph.settle(state.poses);
  state.variance = varianceFactor(evaluator, state.in, state.poses, graph.unknowns(), thresholds, scale.factor);
  state.evidence = evaluator.evaluate(graph, state.in, state.poses, state.variance, small_group, kUncontrolledSettled);
  if (!state.evidence.known) return 0;
  AdmissionRound<D> round(evaluator, group, thresholds, state.evidence, state.in);
  round.expel(expelled);
  if (round.changes > 0) reprieve(evaluator, group, thresholds, state, graph, round, expelled);
  if (round.changes == 0) round.admitLikely(expelled);
  if (round.changes == 0) return 0;
  state.in = std::move(round.next);
  graph.take(state.in);
  graph.relax(state.poses, kRoundSteps, kRoundShare, true);
  return round.changes;
}

template std::size_t validateFinally<2>(const ClosureEvaluator<2>&, const std::vector<int>&, const std::vector<int>&,
                                        const Thresholds&, const InformationScale&, std::vector<int>&,
                                        AcceptedGraph<2>&, AdmissionState<2>&);
template std::size_t validateFinally<3>(const ClosureEvaluator<3>&, const std::vector<int>&, const std::vector<int>&,
                                        const Thresholds&, const InformationScale&, std::vector<int>&,
                                        AcceptedGraph<3>&, AdmissionState<3>&);

}  // namespace pose_graph
