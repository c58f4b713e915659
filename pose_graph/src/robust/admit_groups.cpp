// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "linear/index.hpp"
#include "robust/admission.hpp"
#include "robust/exchange_group.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace pose_graph {

namespace {

// Groups outside that are worth a try, the largest first.
template <int D>
std::vector<std::vector<int>> groupsToTry(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group,
                                          const Thresholds& thresholds, const std::set<int>& tried,
                                          const AdmissionState<D>& state) {
  std::map<int, std::vector<int>> outside;
  for (int e : evaluator.candidates())
    if (!state.in[sz(e)] && evaluator.edge(e).rank > 0 && !tried.count(group[sz(e)]))
      outside[group[sz(e)]].push_back(e);
  std::vector<std::vector<int>> made;
  for (auto& [name, members] : outside) {
    std::vector<double> chi2;
    for (int e : members) chi2.push_back(state.evidence.chi2[sz(e)]);
    const auto middle = chi2.begin() + static_cast<std::ptrdiff_t>(chi2.size() / 2);
    std::nth_element(chi2.begin(), middle, chi2.end());
    if (members.size() > 1 && *middle <= kArc * thresholds.limit.back()) made.push_back(std::move(members));
  }
  std::stable_sort(made.begin(), made.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return made;
}

}  // namespace

template <int D>
bool admitOneGroup(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group, const Thresholds& thresholds,
                   std::set<int>& tried, AcceptedGraph<D>& graph, AdmissionState<D>& state) {
  const std::vector<std::vector<int>> groups = groupsToTry(evaluator, group, thresholds, tried, state);
  if (groups.empty() || tried.size() >= kTries) return false;
  graph.relax(state.poses, kGroupSteps, kGroupShare, false);
  const double before = graph.cost(state.poses);
  for (const std::vector<int>& members : groups) {
    if (tried.size() >= kTries) break;
    tried.insert(group[sz(members.front())]);
    std::vector<char> in = state.in;
    int dof = 0;
    double attainable = -1e300;  // the evidence for the best known of them, were it where it is predicted
    int rank = 0;
    for (int e : members) {
      in[sz(e)] = 1;
      dof += evaluator.edge(e).rank;
      const double known = state.evidence.likelier[sz(e)] + 0.5 * state.evidence.chi2[sz(e)];
      if (known > attainable) {
        attainable = known;
        rank = evaluator.edge(e).rank;
      }
    }
    // Nothing is likelier than the prediction itself: no relaxation will find enough.
    if (attainable < Thresholds::kEvidence) continue;
    std::vector<Rigid<D>> poses = state.poses;
    graph.take(in);
    const double most = urban_nav_core::chiSquareQuantile(1.0 - Thresholds::kFalseAlarms / kTries, dof);
    // Of what costs more than that it only matters by how much if room could be made.
    const double far =
        members.size() < kForOne ? before + state.variance * most : std::numeric_limits<double>::infinity();
    graph.relax(poses, kGroupSteps, kGroupShare, true, far);
    const double rise = (graph.cost(poses) - before) / state.variance;
    // What the members differ among each other is no evidence against the place that they agree on.
    const double against = std::max(0.0, rise - (dof - rank));
    if (rise <= most ? attainable - 0.5 * against < Thresholds::kEvidence
                     : !exchangeGroup(evaluator, thresholds, members, state.variance, graph, in, poses))
      continue;
    state.in = std::move(in);
    state.poses = std::move(poses);
    return true;
  }
  graph.take(state.in);
  return false;
}

template bool admitOneGroup<2>(const ClosureEvaluator<2>&, const std::vector<int>&, const Thresholds&, std::set<int>&,
                               AcceptedGraph<2>&, AdmissionState<2>&);
template bool admitOneGroup<3>(const ClosureEvaluator<3>&, const std::vector<int>&, const Thresholds&, std::set<int>&,
                               AcceptedGraph<3>&, AdmissionState<3>&);

}  // namespace pose_graph
