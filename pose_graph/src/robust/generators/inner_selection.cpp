// SPDX-License-Identifier: BSD-3-Clause
#include "robust/generators/inner_selection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "condense/core_graph.hpp"
#include "linear/index.hpp"
#include "robust/generators/admission.hpp"

namespace pose_graph {
using urban_nav_core::ClosureVerdict;

namespace {

// Returns the edges inconsistent with an asserted one: edges accepted without assertions that do not fit when it is
// added.
template <int D>
std::vector<int> contradicting(const Problem<D>& problem, int asserted, AdmissionState<D> without,
                               const ClosureEvaluator<D>& evaluator, const Thresholds& thresholds) {
  AcceptedGraph<D> graph(problem);
  without.in[sz(asserted)] = 1;
  graph.take(without.in);
  graph.relax(without.poses, kMostSteps, 1e-3, true);
  std::vector<std::pair<double, int>> off;
  for (std::size_t e = 0; e < without.in.size(); ++e) {
    if (!without.in[e] || static_cast<int>(e) == asserted) continue;
    const WhitenedEdge<D>& edge = evaluator.edge(static_cast<int>(e));
    const double square =
        whitenedError(edge, without.poses[sz(edge.from)], without.poses[sz(edge.to)]).squaredNorm() / without.variance;
    if (square > thresholds.limit[sz(edge.rank)]) off.emplace_back(-square, static_cast<int>(e));
  }
  std::sort(off.begin(), off.end());
  std::vector<int> made;
  for (const auto& [square, e] : off) made.push_back(e);
  return made;
}

template <int D>
SelectedEdges<D> selectInGraph(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const DeadReckoning<D>& reckoning, double most_work) {
  std::vector<int> candidates, asserted;
  for (std::size_t e = 0; e < roles.size(); ++e) {
    if (roles[e] == EdgeRole::Candidate) candidates.push_back(static_cast<int>(e));
    if (roles[e] == EdgeRole::Asserted) asserted.push_back(static_cast<int>(e));
  }
  const Thresholds thresholds(candidates.size(), kTangentSize<D>);
  const ClosureEvaluator<D> evaluator(problem, candidates, reckoning);
  const ClosureLoops<D> loops(problem, candidates, reckoning);
  const InformationScale scale = informationScale(loops);
  const std::vector<int> group = consistentGroups(problem.edges.size(), loops, std::max(1.0, scale.factor), thresholds);
  AdmissionState<D> state = admitClosures(problem, roles, evaluator, group, thresholds, scale, most_work);
  if (state.is_too_dense) {
    SelectedEdges<D> given_up;
    given_up.is_too_dense = true;
    return given_up;
  }
  if (state.evidence.known) readmitByTruncatedSquares(problem, roles, evaluator, most_work, state);

  SelectedEdges<D> made;
  made.variance = state.variance;
  made.edges.resize(roles.size());
  for (std::size_t e = 0; e < roles.size(); ++e) {
    EdgeAssessment& verdict = made.edges[e];
    const WhitenedEdge<D>& edge = evaluator.edge(static_cast<int>(e));
    verdict.dof = edge.rank;
    if (roles[e] != EdgeRole::Candidate) continue;
    const double chi2 = state.evidence.known
                            ? state.evidence.chi2[e] * state.variance
                            : whitenedError(edge, state.poses[sz(edge.from)], state.poses[sz(edge.to)]).squaredNorm();
    verdict.chi2 = std::isfinite(chi2) ? chi2 : 0.0;
    if (state.in[e]) {
      verdict.reason = Reason::Fits;
      continue;
    }
    verdict.weight = 0.0;
    verdict.verdict = ClosureVerdict::Rejected;
    verdict.reason = !std::isfinite(chi2)                                      ? Reason::NoWitness
                     : chi2 > state.variance * thresholds.limit[sz(edge.rank)] ? Reason::Disagrees
                                                                               : Reason::Unconfirmed;
  }
  made.poses = std::move(state.poses);
  if (asserted.empty()) return made;

  std::vector<EdgeRole> trusting = roles;
  Problem<D> unasserted = problem;
  for (int e : asserted) {
    unasserted.edges[sz(e)].information.setZero();  // without effect, and edge numbers are unchanged
    trusting[sz(e)] = EdgeRole::Trusted;
  }
  const ClosureEvaluator<D> unasserted_evaluator(unasserted, candidates, reckoning);
  AdmissionState<D> without =
      admitClosures(unasserted, trusting, unasserted_evaluator, group, thresholds, scale, most_work);
  for (int e : asserted) without.in[sz(e)] = 0;
  for (int e : asserted) made.edges[sz(e)].contradicted_by = contradicting(problem, e, without, evaluator, thresholds);
  return made;
}

bool sameVerdicts(const std::vector<EdgeAssessment>& a, const std::vector<EdgeAssessment>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const EdgeAssessment& one, const EdgeAssessment& other) {
    return one.verdict == other.verdict;
  });
}

// Selects in the core graph. Its chains are linearised at odometry, and relinearised at the accepted solution until the
// verdicts no longer change.
template <int D>
SelectedEdges<D> selectInCore(CoreGraph<D>& core, const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                              double most_work) {
  const DeadReckoning<D> whole(problem, roles);
  SelectedEdges<D> selected;
  for (int reading = 0; reading < kRepeats; ++reading) {
    if (reading > 0) core.relinearise();
    DeadReckoning<D> reckoning(core.problem(), core.roles());
    reckoning.extent = whole.extent;
    for (std::size_t i = 0; i < reckoning.way.size(); ++i)
      reckoning.way[i] = whole.way[sz(core.pose(static_cast<int>(i)))];
    SelectedEdges<D> again = selectInGraph(core.problem(), core.roles(), reckoning, most_work);
    if (again.is_too_dense) return again;
    const bool settled = reading > 0 && sameVerdicts(selected.edges, again.edges);
    selected = std::move(again);
    core.expanded(selected.poses);
    if (settled || std::none_of(selected.edges.begin(), selected.edges.end(), [](const EdgeAssessment& verdict) {
          return verdict.verdict == ClosureVerdict::Rejected;
        }))
      break;
  }
  SelectedEdges<D> made;
  made.variance = selected.variance;
  made.poses = core.expanded(selected.poses);
  made.edges.resize(roles.size());
  for (EdgeAssessment& verdict : made.edges)
    verdict.dof = kTangentSize<D>;  // for edges of chains, which have full rank
  for (std::size_t e = 0; e < selected.edges.size(); ++e) {
    EdgeAssessment& verdict = selected.edges[e];
    for (int& other : verdict.contradicted_by) other = core.edge(other);
    verdict.contradicted_by.erase(std::remove(verdict.contradicted_by.begin(), verdict.contradicted_by.end(), -1),
                                  verdict.contradicted_by.end());
    if (core.edge(static_cast<int>(e)) >= 0) made.edges[sz(core.edge(static_cast<int>(e)))] = std::move(verdict);
  }
  return made;
}

}  // namespace

template <int D>
SelectedEdges<D> selectEdges(const Problem<D>& problem, const std::vector<EdgeRole>& roles, double most_work) {
  auto core = CoreGraph<D>::of(problem, roles);
  return core ? selectInCore(*core, problem, roles, most_work)
              : selectInGraph(problem, roles, DeadReckoning<D>(problem, roles), most_work);
}

namespace {

// A relaxed set of closures, and its evidence for each closure with own variances larger by `own`.
template <int D>
struct SettledSet {
  std::vector<Rigid<D>> poses;
  Thresholds thresholds;
  ClosureEvaluator<D> evaluator;
  Evidence evidence;

  SettledSet(const Problem<D>& problem, const std::vector<int>& candidates, const DeadReckoning<D>& reckoning,
             const std::vector<char>& in, std::vector<Rigid<D>> from, const std::vector<int>& row, double own)
      : poses(std::move(from)),
        thresholds(candidates.size(), kTangentSize<D>),
        evaluator(problem, candidates, reckoning) {
    AcceptedGraph<D> graph(problem);
    graph.take(in);
    graph.settle(poses);
    evidence = evaluator.evaluate(graph, in, poses, 1.0, row, kSettled, own);
  }

  bool fits(int e) const {
    return evidence.known && evidence.chi2[sz(e)] <= findLimit(thresholds, evaluator.edge(e)) &&
           evidence.likelier[sz(e)] >= Thresholds::kEvidence;
  }
  bool isContradictedAlone(int e) const {
    return evidence.known && evidence.chi2[sz(e)] > sampledMargin() * findLimit(thresholds, evaluator.edge(e));
  }
  bool isContradictedAsRow(int e) const {
    return evidence.known && evidence.group_chi2[sz(e)] > sampledMargin() * thresholds.limit.back();
  }
};

std::vector<int> listCandidates(const std::vector<EdgeRole>& roles) {
  std::vector<int> candidates;
  for (std::size_t e = 0; e < roles.size(); ++e)
    if (roles[e] == EdgeRole::Candidate) candidates.push_back(static_cast<int>(e));
  return candidates;
}

}  // namespace

template <int D>
bool contradictsItself(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
                       std::vector<Rigid<D>> poses, const std::vector<int>& row, double own) {
  const std::vector<int> candidates = listCandidates(roles);
  const DeadReckoning<D> reckoning(problem, roles);
  const SettledSet<D> set(problem, candidates, reckoning, in, std::move(poses), row, own);
  std::size_t alone = 0;
  for (const int e : candidates) {
    if (!in[sz(e)]) continue;
    if (set.isContradictedAsRow(e)) return true;
    alone += set.isContradictedAlone(e);
  }
  return static_cast<double>(alone) > Thresholds::kContested * static_cast<double>(candidates.size());
}

template <int D>
std::vector<char> findFitting(const Problem<D>& problem, const std::vector<EdgeRole>& roles, std::vector<char> in,
                              std::vector<Rigid<D>> poses, const std::vector<int>& row, double own) {
  const std::vector<int> candidates = listCandidates(roles);
  const DeadReckoning<D> reckoning(problem, roles);
  const SettledSet<D> without(problem, candidates, reckoning, in, std::move(poses), row, own);
  std::vector<char> fitting(roles.size(), 0);
  Problem<D> wider = problem;
  for (const int e : candidates) {
    fitting[sz(e)] = !in[sz(e)] && without.fits(e);
    if (!fitting[sz(e)]) continue;
    in[sz(e)] = 1;
    wider.edges[sz(e)].information /= own;
  }
  const SettledSet<D> with(wider, candidates, reckoning, in, without.poses, row, 1.0);
  for (const int e : candidates)
    fitting[sz(e)] = fitting[sz(e)] && !with.isContradictedAlone(e) && !with.isContradictedAsRow(e);
  return fitting;
}

template bool contradictsItself<2>(const Problem<2>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                   std::vector<Rigid<2>>, const std::vector<int>&, double);
template bool contradictsItself<3>(const Problem<3>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                   std::vector<Rigid<3>>, const std::vector<int>&, double);
template std::vector<char> findFitting<2>(const Problem<2>&, const std::vector<EdgeRole>&, std::vector<char>,
                                          std::vector<Rigid<2>>, const std::vector<int>&, double);
template std::vector<char> findFitting<3>(const Problem<3>&, const std::vector<EdgeRole>&, std::vector<char>,
                                          std::vector<Rigid<3>>, const std::vector<int>&, double);
template SelectedEdges<2> selectEdges<2>(const Problem<2>&, const std::vector<EdgeRole>&, double);
template SelectedEdges<3> selectEdges<3>(const Problem<3>&, const std::vector<EdgeRole>&, double);

}  // namespace pose_graph
