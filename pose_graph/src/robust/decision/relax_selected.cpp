// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "linear/disjoint_sets.hpp"
#include "linear/index.hpp"
#include "objective/objective.hpp"
#include "pose_graph/robust.hpp"
#include "robust/decision/selection.hpp"
#include "solve/tangled.hpp"

namespace pose_graph {
using urban_nav_core::ClosureVerdict;

const char* toString(Reason reason) {
  switch (reason) {
    case Reason::Role: return "not subject to selection";
    case Reason::Fits: return "consistent with the accepted edges";
    case Reason::Disagrees: return "inconsistent with the accepted edges";
    case Reason::Unconfirmed: return "too uncertain for a test, and not confirmed by another closure";
    case Reason::Slipped: return "odometry slip: contradicted by all other edges";
    case Reason::Undecided: return "a set of closures without it, or odometry only, is nearly as likely";
    case Reason::NoWitness: return "joins two parts, and not confirmed by a second closure";
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

/// A graph in which bit-identical edges, which are not independent measurements, count once.
template <int D>
struct UniqueEdges {
  Problem<D> problem;
  std::vector<EdgeRole> roles;
  std::vector<int> of_edge;  ///< by edge of the whole graph
};

template <int D>
UniqueEdges<D> uniqueEdges(const Problem<D>& problem, const std::vector<EdgeRole>& roles) {
  UniqueEdges<D> made;
  made.problem = problem.withoutEdges();
  std::unordered_map<std::uint64_t, int> latest;  // latest edge between two poses, linked to the previous one
  std::vector<int> before;
  latest.reserve(roles.size());
  for (std::size_t e = 0; e < roles.size(); ++e) {
    const Edge<D>& edge = problem.edges[e];
    int& last = latest.emplace(std::uint64_t{sz(edge.from)} << 32 | sz(edge.to), -1).first->second;
    int same = last;
    for (; same >= 0; same = before[sz(same)]) {
      const Edge<D>& other = made.problem.edges[sz(same)];
      if (other.Z.t == edge.Z.t && other.Z.R == edge.Z.R && other.information == edge.information &&
          other.lever == edge.lever)
        break;
    }
    if (same >= 0) {
      made.of_edge.push_back(same);
      if (roles[e] != EdgeRole::Candidate) made.roles[sz(same)] = roles[e];
      continue;
    }
    before.push_back(std::exchange(last, static_cast<int>(made.problem.edges.size())));
    made.of_edge.push_back(last);
    made.problem.edges.push_back(edge);
    made.roles.push_back(roles[e]);
  }
  return made;
}

template <int D>
Problem<D> extractPart(const Problem<D>& problem, const std::vector<char>& in, std::vector<Rigid<D>> poses) {
  Problem<D> part{std::move(poses), {}, problem.fixed};
  for (std::size_t e = 0; e < in.size(); ++e)
    if (in[e]) part.edges.push_back(problem.edges[e]);
  return part;
}

template <int D>
double computeCost(const Edge<D>& edge, const std::vector<Rigid<D>>& poses) {
  return edgeCost<Objective::Geodesic, D>(makeTerm(edge), poses[sz(edge.from)], poses[sz(edge.to)]);
}

// Relaxes from the result of the selection, which is usually near the minimum. If it is at the end of a long flat
// valley of the cost (over a long path with few closures, displacements of hundreds of metres hardly change the cost),
// relaxation from a new initial guess is faster.
template <int D>
Solution<D> relaxAccepted(const Problem<D>& part, const std::vector<Rigid<D>>& given, const SolveOptions& options) {
  if (options.start != Start::Auto) return solve(part, options);
  SolveOptions near = options;
  near.start = Start::Vertices;
  near.iterations = std::min(options.iterations, kSettleSteps);
  Solution<D> made = solve(part, near);
  if (made.ending != Ending::Iterations || options.iterations <= kSettleSteps) return made;
  SolveOptions anew = options;
  anew.untangle = options.untangle && isTangled(part, {}, made.poses);
  Solution<D> afresh = solve(Problem<D>{given, part.edges, part.fixed}, anew);
  if (afresh.cost <= made.cost) return afresh;
  near.iterations = options.iterations - kSettleSteps;
  return solve(Problem<D>{std::move(made.poses), part.edges, part.fixed}, near);
}

template <int D>
RobustSolution<D> solutionFrom(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const SolveOptions& options, SelectedEdges<D> selected) {
  // The solver for graphs without false edges computes the final poses from the accepted edges.
  std::vector<char> in;
  for (const EdgeAssessment& verdict : selected.edges) in.push_back(verdict.weight > 0.0);
  RobustSolution<D> made;
  made.solution = relaxAccepted(extractPart(problem, in, std::move(selected.poses)), problem.poses, options);
  made.solution.cost_before = cost(problem, problem.poses, options.objective);
  made.variance_factor = selected.variance;
  made.edges = std::move(selected.edges);
  for (std::size_t e = 0; e < roles.size(); ++e)
    if (roles[e] != EdgeRole::Candidate) made.edges[e].chi2 = computeCost(problem.edges[e], made.solution.poses);
  return made;
}

/// Rejects the closures of all poses except those in `stays`, which leaves odometry. Closures that fitted the accepted
/// edges become undecided.
template <int D>
void rejectCandidates(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& stays,
                      std::vector<EdgeAssessment>& edges) {
  for (std::size_t e = 0; e < roles.size(); ++e) {
    if (stays[static_cast<std::size_t>(problem.edges[e].from)]) continue;
    const bool is_closure = roles[e] == EdgeRole::Candidate;
    edges[e].weight = is_closure ? 0.0 : 1.0;
    edges[e].verdict = is_closure ? ClosureVerdict::Rejected : ClosureVerdict::Accepted;
    if (!is_closure) edges[e].reason = Reason::Role;
    else if (edges[e].reason == Reason::Fits) edges[e].reason = Reason::Undecided;
  }
}

}  // namespace

template <int D>
RobustSolution<D> relaxRobust(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                              const SolveOptions& options) {
  return solutionFrom(problem, roles, options, selectEdges(problem, roles));
}

template <int D>
RobustSolution<D> relaxSelected(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                const SolveOptions& options) {
  const UniqueEdges<D> unique = uniqueEdges(problem, roles);
  Selection<D> selection(unique.problem, unique.roles);
  selection.run();
  SelectionReport report;
  report.unweighed = selection.isUnweighed();
  VarianceFactors factors;
  bool takes_unopposed = false;  // sessions joined by uncontested closures
  if (selection.wasScored()) {
    report.contested = selection.wasContested();
    report.log_evidence = selection.evidence();
    report.undecided = selection.isUndecided();
    takes_unopposed = selection.unopposed() && (report.undecided || selection.rejectsAny());
    const bool is_decided = !report.undecided && !takes_unopposed, has_other_set = is_decided && selection.keepShared();
    report.has_rival = has_other_set || (is_decided && selection.contradictsOdometry());
    if (selection.hasVariances()) factors = selection.hypothesis().factors;
    report.odometry_factor = factors.odometry;
    report.closure_factor = factors.closures;
    report.rescaled = !report.undecided && !has_other_set && selection.isRescaled();
  }
  const std::vector<char> stays = report.undecided ? selection.inUncontestedParts() : std::vector<char>();
  SelectedEdges<D> chosen = takes_unopposed ? *selection.unopposed() : selection.take();
  if (report.undecided || takes_unopposed) {
    factors = {};
    report.odometry_factor = report.closure_factor = 1.0;
    report.rescaled = false;
  }
  if (takes_unopposed) {
    report.has_rival = selection.isThinlyJoined();
    report.undecided = false;
  } else if (report.undecided) {
    for (std::size_t i = 0; i < stays.size(); ++i)
      if (!stays[i]) chosen.poses[i] = selection.odometryAlone().poses[i];
    for (const int pose : problem.fixed) chosen.poses[sz(pose)] = problem.poses[sz(pose)];
    rejectCandidates(unique.problem, unique.roles, stays, chosen.edges);
  }
  SelectedEdges<D> all;
  all.poses = std::move(chosen.poses);
  all.variance = chosen.variance;
  for (const int e : unique.of_edge) all.edges.push_back(chosen.edges[sz(e)]);
  RobustSolution<D> made = report.rescaled
                               ? solutionFrom(withFactors(problem, roles, factors), roles, options, std::move(all))
                               : solutionFrom(problem, roles, options, std::move(all));
  made.selection = report;
  return made;
}

template std::vector<EdgeRole> rolesByNumbers<2>(const Problem<2>&);
template std::vector<EdgeRole> rolesByNumbers<3>(const Problem<3>&);
template RobustSolution<2> relaxRobust<2>(const Problem<2>&, const std::vector<EdgeRole>&, const SolveOptions&);
template RobustSolution<3> relaxRobust<3>(const Problem<3>&, const std::vector<EdgeRole>&, const SolveOptions&);
template RobustSolution<2> relaxSelected<2>(const Problem<2>&, const std::vector<EdgeRole>&, const SolveOptions&);
template RobustSolution<3> relaxSelected<3>(const Problem<3>&, const std::vector<EdgeRole>&, const SolveOptions&);

}  // namespace pose_graph
