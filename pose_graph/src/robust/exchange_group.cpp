// SPDX-License-Identifier: BSD-3-Clause
#include "robust/exchange_group.hpp"

#include <algorithm>

#include "linear/index.hpp"

namespace pose_graph {

namespace {

constexpr int kRoomRounds = 4;

}  // namespace

template <int D>
bool exchangeGroup(const ClosureEvaluator<D>& evaluator, const Thresholds& thresholds, const std::vector<int>& members,
                   double variance, AcceptedGraph<D>& graph, std::vector<char>& in, std::vector<Rigid<D>>& poses) {
  if (members.size() < kForOne) return false;
  const std::vector<int> no_groups(in.size(), -1);
  std::size_t gone = 0;
  for (int round = 0; round < kRoomRounds; ++round) {
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
    graph.relax(poses, kGroupSteps, kGroupShare, false);
  }
  return false;
}

template bool exchangeGroup<2>(const ClosureEvaluator<2>&, const Thresholds&, const std::vector<int>&, double,
                               AcceptedGraph<2>&, std::vector<char>&, std::vector<Rigid<2>>&);
template bool exchangeGroup<3>(const ClosureEvaluator<3>&, const Thresholds&, const std::vector<int>&, double,
                               AcceptedGraph<3>&, std::vector<char>&, std::vector<Rigid<3>>&);

}  // namespace pose_graph
