// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/robust.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "robust/growth.hpp"
#include "robust/information_scale.hpp"

namespace pose_graph {

namespace {

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

int rootOf(std::vector<int>& above, int i) {
  while (above[sz(i)] != i) i = above[sz(i)] = above[sz(above[sz(i)])];
  return i;
}

template <int D>
Problem<D> partOf(const Problem<D>& problem, const std::vector<char>& in, std::vector<Rigid<D>> poses) {
  Problem<D> part;
  part.poses = std::move(poses);
  for (std::size_t e = 0; e < in.size(); ++e)
    if (in[e]) part.edges.push_back(problem.edges[e]);
  return part;
}

// Edges that cannot stand beside an asserted one: those of what is accepted without any assertion that do not fit once
// this one is added.
template <int D>
std::vector<int> contradicting(const Problem<D>& problem, int asserted, Grown<D> without, const Witness<D>& witness,
                               const Thresholds& thresholds) {
  AcceptedGraph<D> graph(problem);
  without.in[sz(asserted)] = 1;
  graph.take(without.in);
  graph.relax(without.poses, 20, 1e-3, true);
  std::vector<std::pair<double, int>> off;
  for (std::size_t e = 0; e < without.in.size(); ++e) {
    if (!without.in[e] || static_cast<int>(e) == asserted) continue;
    const WhitenedEdge<D>& edge = witness.edge(static_cast<int>(e));
    const double square =
        whitenedError(edge, without.poses[sz(edge.from)], without.poses[sz(edge.to)]).squaredNorm() / without.variance;
    if (square > thresholds.limit[sz(edge.rank)]) off.emplace_back(-square, static_cast<int>(e));
  }
  std::sort(off.begin(), off.end());
  std::vector<int> made;
  for (const auto& [square, e] : off) made.push_back(e);
  return made;
}

}  // namespace

const char* toString(Verdict verdict) { return verdict == Verdict::Accepted ? "accepted" : "rejected"; }

const char* toString(Reason reason) {
  switch (reason) {
    case Reason::Role: return "not in question";
    case Reason::Fits: return "agrees with the accepted edges";
    case Reason::Disagrees: return "disagrees with the accepted edges";
    case Reason::Unconfirmed: return "too little is known there, and no other closure agrees";
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
  std::vector<int> above(problem.poses.size());
  std::iota(above.begin(), above.end(), 0);
  for (std::size_t e = 0; e < roles.size(); ++e) {
    const int a = rootOf(above, problem.edges[e].from), b = rootOf(above, problem.edges[e].to);
    if (a == b) continue;
    above[sz(std::max(a, b))] = std::min(a, b);
    roles[e] = EdgeRole::Trusted;
  }
  return roles;
}

template <int D>
RobustSolution<D> relaxRobust(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                              const SolveOptions& options) {
  RobustSolution<D> made;
  std::vector<int> candidates, asserted;
  for (std::size_t e = 0; e < roles.size(); ++e) {
    if (roles[e] == EdgeRole::Candidate) candidates.push_back(static_cast<int>(e));
    if (roles[e] == EdgeRole::Asserted) asserted.push_back(static_cast<int>(e));
  }
  const Chains<D> chains(problem, roles);
  const Thresholds thresholds(candidates.size(), tangent_size<D>);
  const Witness<D> witness(problem, candidates, chains);
  const ClosureLoops<D> loops(problem, candidates, chains);
  const InformationScale scale = informationScale(loops);
  const std::vector<int> group = agreeingGroups(problem.edges.size(), loops, std::max(1.0, scale.factor), thresholds);
  Grown<D> grown = grow(problem, roles, witness, group, thresholds, scale);
  if (grown.evidence.known) takeBack(problem, roles, witness, grown);

  // The last word has the solver of graphs without false edges, on what is left.
  const Problem<D> part = partOf(problem, grown.in, grown.poses);
  SolveOptions last = options;
  last.start = options.start == Start::Auto ? Start::Vertices : options.start;
  made.solution = solve(part, last);
  made.solution.cost_before = cost(problem, problem.poses, options.objective);
  made.variance_factor = grown.variance;

  made.edges.resize(roles.size());
  for (std::size_t e = 0; e < roles.size(); ++e) {
    EdgeVerdict& verdict = made.edges[e];
    const WhitenedEdge<D>& edge = witness.edge(static_cast<int>(e));
    verdict.dof = edge.rank;
    const double own =
        whitenedError(edge, made.solution.poses[sz(edge.from)], made.solution.poses[sz(edge.to)]).squaredNorm();
    if (roles[e] != EdgeRole::Candidate) {
      verdict.chi2 = own;
      continue;
    }
    const double heard = grown.evidence.known ? grown.evidence.chi2[e] * grown.variance : own;
    verdict.chi2 = std::isfinite(heard) ? heard : 0.0;
    if (grown.in[e]) {
      verdict.reason = Reason::Fits;
      continue;
    }
    verdict.weight = 0.0;
    verdict.verdict = Verdict::Rejected;
    verdict.reason = !std::isfinite(heard)                                      ? Reason::NoWitness
                     : heard > grown.variance * thresholds.limit[sz(edge.rank)] ? Reason::Disagrees
                                                                                : Reason::Unconfirmed;
  }
  if (asserted.empty()) return made;

  std::vector<EdgeRole> believed = roles;
  Problem<D> unasserted = problem;
  for (int e : asserted) {
    unasserted.edges[sz(e)].information.setZero();  // says nothing, and keeps the numbers of the others
    believed[sz(e)] = EdgeRole::Trusted;
  }
  const Witness<D> doubter(unasserted, candidates, chains);
  Grown<D> without = grow(unasserted, believed, doubter, group, thresholds, scale);
  for (int e : asserted) without.in[sz(e)] = 0;
  for (int e : asserted) made.edges[sz(e)].contradicted_by = contradicting(problem, e, without, witness, thresholds);
  return made;
}

template std::vector<EdgeRole> rolesByNumbers<2>(const Problem<2>&);
template std::vector<EdgeRole> rolesByNumbers<3>(const Problem<3>&);
template RobustSolution<2> relaxRobust<2>(const Problem<2>&, const std::vector<EdgeRole>&, const SolveOptions&);
template RobustSolution<3> relaxRobust<3>(const Problem<3>&, const std::vector<EdgeRole>&, const SolveOptions&);

}  // namespace pose_graph
