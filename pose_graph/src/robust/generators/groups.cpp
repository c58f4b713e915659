// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "linear/index.hpp"
#include "robust/evidence/variances.hpp"
#include "robust/generators/admission.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace pose_graph {

namespace {

// Factor of the limit up to which an arc explains a residual: errors of odometry over a long path lie on an arc, which
// linearised covariances do not represent. True groups of MIT and kitti_02 reach 4.
constexpr double kArc = 10.0;
// Limit of groups tested with a relaxation each.
constexpr std::size_t kTries = 10;
// Number of true closures per false one that excludes them; a false group excludes as many true closures as it has
// members. Smaller groups exclude none.
constexpr std::size_t kForOne = 8;

// Continues from a graph with a group that contradicts others. Removes the edges inconsistent with the group, the worst
// first. Returns true if all remaining ones fit and few were removed for the size of the group. `in`, `poses`: with the
// group on entry, updated.
template <int D>
bool exchangeGroup(const ClosureEvaluator<D>& evaluator, const Thresholds& thresholds, const std::vector<int>& members,
                   double variance, AcceptedGraph<D>& graph, std::vector<char>& in, std::vector<Rigid<D>>& poses) {
  if (members.size() < kForOne) return false;
  const std::vector<int> no_groups(in.size(), -1);
  std::size_t gone = 0;
  for (;;) {  // decreases in each round
    const Evidence evidence = evaluator.evaluate(graph, in, poses, variance, no_groups, kUncontrolled);
    if (!evidence.known) return false;
    double worst = 0.0;
    for (int e : evaluator.candidates())
      if (in[sz(e)]) worst = std::max(worst, evidence.chi2[sz(e)]);
    bool all_fit = true;
    for (int e : evaluator.candidates()) {
      if (!in[sz(e)] ||
          evidence.chi2[sz(e)] <= leavesBeyond(thresholds, findLimit(thresholds, evaluator.edge(e)), worst))
        continue;
      in[sz(e)] = 0;
      all_fit = false;
      ++gone;
    }
    if (gone * kForOne > members.size()) return false;
    if (all_fit) return true;
    graph.take(in);
    graph.relax(poses, kMostSteps, kSettled, false);
  }
}

// Returns the rejected groups worth a trial, the largest first.
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
  graph.relax(state.poses, kMostSteps, kSettled, false);
  const double before = graph.cost(state.poses);
  for (const std::vector<int>& members : groups) {
    if (tried.size() >= kTries) break;
    tried.insert(group[sz(members.front())]);
    std::vector<char> in = state.in;
    int dof = 0;
    double attainable = -1e300;  // evidence for the best constrained member, if it were at its predicted pose
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
    // The residual is smallest at the prediction itself: no relaxation can yield sufficient evidence.
    if (attainable < Thresholds::kEvidence) continue;
    std::vector<Rigid<D>> poses = state.poses;
    graph.take(in);
    const double most = urban_nav_core::chiSquareQuantile(1.0 - Thresholds::kFalseAlarms / kTries, dof);
    // If the cost exceeds this, its value matters only for an exchange.
    const double far =
        members.size() < kForOne ? before + state.variance * most : std::numeric_limits<double>::infinity();
    graph.relax(poses, kMostSteps, kSettled, true, far);
    const double rise = (graph.cost(poses) - before) / state.variance;
    // Differences among the members are no evidence against their common pose.
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

namespace {

// Returns whether the converged graph with a group costs no more than chance explains for all its members. If the group
// closes a long path, the linearised test assumes a straight line and rejects true closures.
template <int D>
bool isExplained(const ClosureEvaluator<D>& evaluator, const Thresholds& thresholds, const std::vector<int>& members,
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

// Keeps groups about to be removed if an arc may explain them and isExplained() confirms them.
template <int D>
void keepExplainedGroups(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group,
                         const Thresholds& thresholds, const AdmissionState<D>& state, AcceptedGraph<D>& graph,
                         AdmissionRound<D>& round, std::vector<int>& expelled) {
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
    if (!isExplained(evaluator, thresholds, members[name], graph, state, cost)) continue;
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
  state.evidence = evaluator.evaluate(graph, state.in, state.poses, state.variance, small_group, kSettled);
  if (!state.evidence.known) return 0;
  AdmissionRound<D> round(evaluator, group, thresholds, state.evidence, state.in);
  round.expel(expelled);
  if (round.changes > 0) keepExplainedGroups(evaluator, group, thresholds, state, graph, round, expelled);
  if (round.changes == 0) round.admitLikely(expelled);
  if (round.changes == 0) return 0;
  state.in = std::move(round.next);
  graph.take(state.in);
  graph.relax(state.poses, kRoundSteps, kRoundShare, true);
  return round.changes;
}

template bool admitOneGroup<2>(const ClosureEvaluator<2>&, const std::vector<int>&, const Thresholds&, std::set<int>&,
                               AcceptedGraph<2>&, AdmissionState<2>&);
template bool admitOneGroup<3>(const ClosureEvaluator<3>&, const std::vector<int>&, const Thresholds&, std::set<int>&,
                               AcceptedGraph<3>&, AdmissionState<3>&);
template std::size_t validateFinally<2>(const ClosureEvaluator<2>&, const std::vector<int>&, const std::vector<int>&,
                                        const Thresholds&, const InformationScale&, std::vector<int>&,
                                        AcceptedGraph<2>&, AdmissionState<2>&);
template std::size_t validateFinally<3>(const ClosureEvaluator<3>&, const std::vector<int>&, const std::vector<int>&,
                                        const Thresholds&, const InformationScale&, std::vector<int>&,
                                        AcceptedGraph<3>&, AdmissionState<3>&);

}  // namespace pose_graph
