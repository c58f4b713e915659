// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include "linear/index.hpp"
#include "robust/growth.hpp"
#include "robust/round.hpp"
#include "robust/variance_factor.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace pose_graph {

namespace {

// Whether the settled graph costs no more with a group than chance explains for all its members together: where it
// closes a long way its linearised test sees a straight line, and finds true ones too far off.
template <int D>
bool stands(const Witness<D>& witness, const Thresholds& thresholds, const std::vector<int>& members,
            AcceptedGraph<D>& graph, const Grown<D>& grown, double cost) {
  std::vector<char> in = grown.in;
  int dof = 0;
  for (int e : members) {
    in[sz(e)] = 0;
    dof += witness.edge(e).rank;
  }
  std::vector<Rigid<D>> poses = grown.poses;
  graph.take(in);
  graph.settle(poses);
  const double rise = (cost - graph.cost(poses)) / grown.variance;
  return rise <= urban_nav_core::chiSquareQuantile(1.0 - thresholds.kFalseAlarms / kTries, dof);
}

// Groups that would leave and that an arc may explain stay if they stand.
template <int D>
void reprieve(const Witness<D>& witness, const std::vector<int>& group, const Thresholds& thresholds,
              const Grown<D>& grown, AcceptedGraph<D>& graph, Round<D>& round, std::vector<int>& expelled) {
  std::map<int, std::vector<int>> members, leaving;
  for (int e : witness.candidates()) {
    if (!grown.in[sz(e)]) continue;
    members[group[sz(e)]].push_back(e);
    const double off = grown.evidence.group_chi2[sz(e)];
    if (!round.next[sz(e)] && off > 0.0 && off <= kArc * thresholds.limit.back()) leaving[group[sz(e)]].push_back(e);
  }
  const double cost = graph.cost(grown.poses);
  std::size_t tries = 0;
  for (const auto& [name, some] : leaving) {
    if (++tries > kTries) break;
    if (!stands(witness, thresholds, members[name], graph, grown, cost)) continue;
    for (int e : some) {
      round.next[sz(e)] = 1;
      --expelled[sz(e)];
      --round.changes;
    }
  }
  graph.take(grown.in);
}

}  // namespace

template <int D>
std::size_t lastWord(const Witness<D>& witness, const std::vector<int>& group, const std::vector<int>& small_group,
                     const Thresholds& thresholds, const InformationScale& scale, std::vector<int>& expelled,
                     AcceptedGraph<D>& graph, Grown<D>& grown) {
  graph.settle(grown.poses);
  grown.variance = varianceFactor(witness, grown.in, grown.poses, graph.unknowns(), thresholds, scale.factor);
  grown.evidence = witness.hear(graph, grown.in, grown.poses, grown.variance, small_group, kUncontrolledSettled);
  if (!grown.evidence.known) return 0;
  Round<D> round(witness, group, thresholds, grown.evidence, grown.in);
  round.expel(expelled);
  if (round.changes > 0) reprieve(witness, group, thresholds, grown, graph, round, expelled);
  if (round.changes == 0) round.admitLikely(expelled);
  if (round.changes == 0) return 0;
  grown.in = std::move(round.next);
  graph.take(grown.in);
  graph.relax(grown.poses, kRoundSteps, kRoundShare, true);
  return round.changes;
}

template std::size_t lastWord<2>(const Witness<2>&, const std::vector<int>&, const std::vector<int>&, const Thresholds&,
                                 const InformationScale&, std::vector<int>&, AcceptedGraph<2>&, Grown<2>&);
template std::size_t lastWord<3>(const Witness<3>&, const std::vector<int>&, const std::vector<int>&, const Thresholds&,
                                 const InformationScale&, std::vector<int>&, AcceptedGraph<3>&, Grown<3>&);

}  // namespace pose_graph
