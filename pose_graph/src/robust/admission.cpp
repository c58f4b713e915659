// SPDX-License-Identifier: BSD-3-Clause
#include "robust/admission.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "linear/index.hpp"
#include "robust/admission_round.hpp"
#include "robust/variance_factor.hpp"
#include "start/along_edges.hpp"

namespace pose_graph {

namespace {

constexpr int kGrowthRounds = 30;
// Of the candidates: when fewer change, it is done; when fewer enter, groups may; when more do, the graph is still in
// the making, and only what is beyond doubt enters.
constexpr double kGrowthSettled = 1e-3, kLittle = 0.01, kMuch = 0.05;
constexpr std::size_t kGroup = 20;  // larger groups are no repeated mistake but a way travelled twice

// Groups worth a test for a common bias.
std::vector<int> smallGroups(const std::vector<int>& group) {
  std::map<int, std::size_t> size;
  for (int g : group)
    if (g >= 0) ++size[g];
  std::vector<int> made(group.size(), -1);
  for (std::size_t e = 0; e < group.size(); ++e)
    if (group[e] >= 0 && size[group[e]] > 1 && size[group[e]] <= kGroup) made[e] = group[e];
  return made;
}

}  // namespace

template <int D>
AdmissionState<D> admitClosures(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                const ClosureEvaluator<D>& evaluator, const std::vector<int>& group,
                                const Thresholds& thresholds, const InformationScale& scale, double most_work) {
  AdmissionState<D> state;
  for (std::size_t e = 0; e < problem.edges.size(); ++e)
    state.in.push_back(evaluator.edge(static_cast<int>(e)).rank > 0);  // a link without information joins nothing
  for (int e : evaluator.candidates()) state.in[sz(e)] = 0;
  Problem<D> part = problem.withoutEdges();
  bool asserted = false;
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    if (state.in[e] && roles[e] == EdgeRole::Trusted) part.edges.push_back(problem.edges[e]);
    asserted |= roles[e] == EdgeRole::Asserted;
  }
  state.poses = posesAlongEdges(part);
  AcceptedGraph<D> graph(problem, most_work);
  graph.take(state.in);
  graph.relax(state.poses, kRoundSteps, kRoundShare, asserted);
  const std::vector<int> small = smallGroups(group);
  std::vector<int> expelled(problem.edges.size(), 0);
  std::set<int> tried;
  bool all = false;
  const double candidates = static_cast<double>(evaluator.candidates().size());
  const auto isFew = [&](std::size_t changes) { return static_cast<double>(changes) <= kGrowthSettled * candidates; };
  for (int round = 0; round < kGrowthRounds; ++round) {
    state.variance = varianceFactor(evaluator, state.in, state.poses, graph.unknowns(), thresholds, scale.factor);
    state.evidence = evaluator.evaluate(graph, state.in, state.poses, state.variance, small, kUncontrolled);
    if (!state.evidence.known) break;
    if (round == 0) all = admitAll(evaluator, group, small, thresholds, scale, graph, state);
    AdmissionRound<D> now(evaluator, group, thresholds, state.evidence, state.in);
    now.expel(expelled);
    now.admit(expelled, thresholds.early_evidence);
    const auto much = [&] { return static_cast<double>(now.admitted) > kMuch * candidates; };
    if (!much()) now.admit(expelled, Thresholds::kEvidence);
    if (static_cast<double>(now.admitted) < kLittle * candidates) {
      now.admitGroups(expelled);
      now.join(graph, expelled);
    }
    const bool few = isFew(now.changes);
    if (now.changes > 0) {
      state.in = std::move(now.next);
      graph.take(state.in);
      state.is_too_dense = graph.isTooDense();
      if (state.is_too_dense) break;
      graph.relax(state.poses, kRoundSteps, kRoundShare, now.joined || much() || round < 5);
    }
    if (!few || now.joined || admitOneGroup(evaluator, group, thresholds, tried, graph, state)) continue;
    const bool unquestioned = all && std::count(state.in.begin(), state.in.end(), 0) == 0;
    if (unquestioned) break;
    // So few changes that a round would end there are judged where they are settled, and by no round before.
    std::size_t changes = 0;
    do {
      changes = validateFinally(evaluator, group, small, thresholds, scale, expelled, graph, state);
    } while (changes > 0 && isFew(changes) && ++round < kGrowthRounds);
    if (changes == 0) break;
  }
  return state;
}

template AdmissionState<2> admitClosures<2>(const Problem<2>&, const std::vector<EdgeRole>&, const ClosureEvaluator<2>&,
                                            const std::vector<int>&, const Thresholds&, const InformationScale&,
                                            double);
template AdmissionState<3> admitClosures<3>(const Problem<3>&, const std::vector<EdgeRole>&, const ClosureEvaluator<3>&,
                                            const std::vector<int>&, const Thresholds&, const InformationScale&,
                                            double);

}  // namespace pose_graph
