// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/robust.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "linear/disjoint_sets.hpp"
#include "linear/index.hpp"
#include "objective/objective.hpp"
#include "robust/admission.hpp"
#include "robust/core_graph.hpp"
#include "robust/information_scale.hpp"
#include "robust/judgement.hpp"
#include "solve/tangled.hpp"

namespace pose_graph {
using urban_nav_core::ClosureVerdict;

namespace {

template <int D>
Problem<D> extractPart(const Problem<D>& problem, const std::vector<char>& in, std::vector<Rigid<D>> poses) {
  Problem<D> part{std::move(poses), {}, problem.fixed};
  for (std::size_t e = 0; e < in.size(); ++e)
    if (in[e]) part.edges.push_back(problem.edges[e]);
  return part;
}

// Edges that cannot stand beside an asserted one: those of what is accepted without any assertion that do not fit once
// this one is added.
template <int D>
std::vector<int> contradicting(const Problem<D>& problem, int asserted, AdmissionState<D> without,
                               const ClosureEvaluator<D>& evaluator, const Thresholds& thresholds) {
  AcceptedGraph<D> graph(problem);
  without.in[sz(asserted)] = 1;
  graph.take(without.in);
  graph.relax(without.poses, 20, 1e-3, true);
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
double computeCost(const Edge<D>& edge, const std::vector<Rigid<D>>& poses) {
  return edgeCost<Objective::Geodesic, D>(makeTerm(edge), poses[sz(edge.from)], poses[sz(edge.to)]);
}

}  // namespace

const char* toString(Reason reason) {
  switch (reason) {
    case Reason::Role: return "not in question";
    case Reason::Fits: return "agrees with the accepted edges";
    case Reason::Disagrees: return "disagrees with the accepted edges";
    case Reason::Unconfirmed: return "too little is known there, and no other closure agrees";
    case Reason::Slipped: return "odometry slipped: all other edges contradict it";
    case Reason::Undecided: return "a set of closures without it, or odometry alone, is nearly as likely";
    case Reason::NoWitness: return "joins two parts, and no second closure agrees";
  }
  return "";
}

template <int D>
std::vector<EdgeRole> rolesByNumbers(const Problem<D>& problem) {
  std::vector<EdgeRole> roles(problem.edges.size(), EdgeRole::Candidate);
  std::vector<char> stepped(problem.poses.size(), 0);
  bool any = false;
  for (std::size_t e = 0; e < roles.size(); ++e) {
    const Edge<D>& edge = problem.edges[e];
    if (std::abs(edge.from - edge.to) != 1 || stepped[sz(std::max(edge.from, edge.to))]) continue;
    stepped[sz(std::max(edge.from, edge.to))] = 1;
    roles[e] = EdgeRole::Trusted;
    any = true;
  }
  if (any) return roles;
  DisjointSets joined(problem.poses.size());
  for (std::size_t e = 0; e < roles.size(); ++e)
    if (joined.join(problem.edges[e].from, problem.edges[e].to)) roles[e] = EdgeRole::Trusted;
  return roles;
}

namespace {

constexpr int kReadings = 3;
constexpr int kNearSteps = 10;  // steps, as in AcceptedGraph::settle

template <int D>
Judgement<D> judge(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const DeadReckoning<D>& reckoning,
                   double most_work) {
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
    Judgement<D> given_up;
    given_up.is_too_dense = true;
    return given_up;
  }
  if (state.evidence.known) readmitByTruncatedSquares(problem, roles, evaluator, most_work, state);

  Judgement<D> made;
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

  std::vector<EdgeRole> believed = roles;
  Problem<D> unasserted = problem;
  for (int e : asserted) {
    unasserted.edges[sz(e)].information.setZero();  // says nothing, and keeps the numbers of the others
    believed[sz(e)] = EdgeRole::Trusted;
  }
  const ClosureEvaluator<D> doubter(unasserted, candidates, reckoning);
  AdmissionState<D> without = admitClosures(unasserted, believed, doubter, group, thresholds, scale, most_work);
  for (int e : asserted) without.in[sz(e)] = 0;
  for (int e : asserted) made.edges[sz(e)].contradicted_by = contradicting(problem, e, without, evaluator, thresholds);
  return made;
}

bool sameVerdicts(const std::vector<EdgeAssessment>& a, const std::vector<EdgeAssessment>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const EdgeAssessment& one, const EdgeAssessment& other) {
    return one.verdict == other.verdict;
  });
}

// The same by way of the core. What a chain says of its ends was read off where odometry laid it: it is read again
// where the accepted closures have put it, as long as that changes what is thought of any.
template <int D>
Judgement<D> judgeCore(CoreGraph<D>& core, const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                       double most_work) {
  const DeadReckoning<D> whole(problem, roles);
  Judgement<D> judged;
  for (int reading = 0; reading < kReadings; ++reading) {
    if (reading > 0) core.relinearise();
    DeadReckoning<D> reckoning(core.problem(), core.roles());
    reckoning.extent = whole.extent;
    for (std::size_t i = 0; i < reckoning.way.size(); ++i)
      reckoning.way[i] = whole.way[sz(core.pose(static_cast<int>(i)))];
    Judgement<D> again = judge(core.problem(), core.roles(), reckoning, most_work);
    if (again.is_too_dense) return again;
    const bool settled = reading > 0 && sameVerdicts(judged.edges, again.edges);
    judged = std::move(again);
    core.expanded(judged.poses);
    if (settled || std::none_of(judged.edges.begin(), judged.edges.end(), [](const EdgeAssessment& verdict) {
          return verdict.verdict == ClosureVerdict::Rejected;
        }))
      break;
  }
  Judgement<D> made;
  made.variance = judged.variance;
  made.poses = core.expanded(judged.poses);
  made.edges.resize(roles.size());
  for (EdgeAssessment& verdict : made.edges)
    verdict.dof = kTangentSize<D>;  // of a chain's: what is singular is in none
  for (std::size_t e = 0; e < judged.edges.size(); ++e) {
    EdgeAssessment& verdict = judged.edges[e];
    for (int& other : verdict.contradicted_by) other = core.edge(other);
    verdict.contradicted_by.erase(std::remove(verdict.contradicted_by.begin(), verdict.contradicted_by.end(), -1),
                                  verdict.contradicted_by.end());
    if (core.edge(static_cast<int>(e)) >= 0) made.edges[sz(core.edge(static_cast<int>(e)))] = std::move(verdict);
  }
  return made;
}

}  // namespace

template <int D>
Judgement<D> judgeGraph(const Problem<D>& problem, const std::vector<EdgeRole>& roles, double most_work) {
  auto core = CoreGraph<D>::of(problem, roles);
  return core ? judgeCore(*core, problem, roles, most_work)
              : judge(problem, roles, DeadReckoning<D>(problem, roles), most_work);
}

// From where the growth left off, which is near as a rule. Where it is at the far end of a long flat valley (over a
// long way that few closures tie, the cost hardly tells hundreds of metres) the way from no first guess is the shorter
// one.
template <int D>
Solution<D> relaxAccepted(const Problem<D>& part, const std::vector<Rigid<D>>& given, const SolveOptions& options) {
  if (options.start != Start::Auto) return solve(part, options);
  SolveOptions near = options;
  near.start = Start::Vertices;
  near.iterations = std::min(options.iterations, kNearSteps);
  Solution<D> made = solve(part, near);
  if (made.ending != Ending::Iterations || options.iterations <= kNearSteps) return made;
  SolveOptions anew = options;
  anew.untangle = options.untangle && isTangled(part, {}, made.poses);
  Solution<D> afresh = solve(Problem<D>{given, part.edges, part.fixed}, anew);
  if (afresh.cost <= made.cost) return afresh;
  near.iterations = options.iterations - kNearSteps;
  return solve(Problem<D>{std::move(made.poses), part.edges, part.fixed}, near);
}

template <int D>
RobustSolution<D> solutionFrom(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const SolveOptions& options, Judgement<D> judged) {
  // The solver of graphs without false edges has the final say, on what is left.
  std::vector<char> in;
  for (const EdgeAssessment& verdict : judged.edges) in.push_back(verdict.weight > 0.0);
  RobustSolution<D> made;
  made.solution = relaxAccepted(extractPart(problem, in, std::move(judged.poses)), problem.poses, options);
  made.solution.cost_before = cost(problem, problem.poses, options.objective);
  made.variance_factor = judged.variance;
  made.edges = std::move(judged.edges);
  for (std::size_t e = 0; e < roles.size(); ++e)
    if (roles[e] != EdgeRole::Candidate) made.edges[e].chi2 = computeCost(problem.edges[e], made.solution.poses);
  return made;
}

template <int D>
RobustSolution<D> relaxRobust(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                              const SolveOptions& options) {
  return solutionFrom(problem, roles, options, judgeGraph(problem, roles));
}

template std::vector<EdgeRole> rolesByNumbers<2>(const Problem<2>&);
template std::vector<EdgeRole> rolesByNumbers<3>(const Problem<3>&);
template Judgement<2> judgeGraph<2>(const Problem<2>&, const std::vector<EdgeRole>&, double);
template Judgement<3> judgeGraph<3>(const Problem<3>&, const std::vector<EdgeRole>&, double);
template RobustSolution<2> solutionFrom<2>(const Problem<2>&, const std::vector<EdgeRole>&, const SolveOptions&,
                                           Judgement<2>);
template RobustSolution<3> solutionFrom<3>(const Problem<3>&, const std::vector<EdgeRole>&, const SolveOptions&,
                                           Judgement<3>);
template RobustSolution<2> relaxRobust<2>(const Problem<2>&, const std::vector<EdgeRole>&, const SolveOptions&);
template RobustSolution<3> relaxRobust<3>(const Problem<3>&, const std::vector<EdgeRole>&, const SolveOptions&);

}  // namespace pose_graph
