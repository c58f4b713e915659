// SPDX-License-Identifier: BSD-3-Clause
#include "graph/jump_gate.hpp"

#include <algorithm>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/relative_pcg.hpp"
#include "pose_graph/robust.hpp"

namespace pose_graph {

namespace {

struct Way {
  Closure* closure;
  int a, b;  // numbers of poses
};

// Odometry's own word for what the closure measures.
bool isLarge(const Problem<3>& problem, const Closure& closure, int a, int b, const Parameters& parameters) {
  const Pose T_a_b =
      poseOf(problem.poses[static_cast<std::size_t>(a)]).inverse() * poseOf(problem.poses[static_cast<std::size_t>(b)]);
  return distanceBetween(T_a_b, closure.measured.T_a_b) > parameters.jump_distance ||
         angleBetween(T_a_b, closure.measured.T_a_b) > parameters.jump_angle * 3.14159265358979323846 / 180.0;
}

std::vector<EdgeRole> rolesOf(std::size_t chains, const std::map<ClosureId, Closure>& closures) {
  std::vector<EdgeRole> roles(chains, EdgeRole::Trusted);
  for (const auto& [id, closure] : closures)
    roles.push_back(closure.kind == EdgeKind::Asserted ? EdgeRole::Asserted : EdgeRole::Candidate);
  return roles;
}

void takeAll(std::map<ClosureId, Closure>& closures) {
  for (auto& [id, closure] : closures) {
    closure.verdict = ClosureVerdict::Accepted;
    closure.weight = 1.0;
    closure.reason = "taken as it is";
  }
}

void take(const RobustSolution<3>& judged, std::size_t chains, std::map<ClosureId, Closure>& closures) {
  std::vector<ClosureId> ids;
  for (const auto& [id, closure] : closures) ids.push_back(id);
  std::size_t e = chains;
  for (auto& [id, closure] : closures) {
    const EdgeVerdict& verdict = judged.edges[e++];
    closure.verdict = verdict.verdict == Verdict::Accepted ? ClosureVerdict::Accepted : ClosureVerdict::Rejected;
    if (verdict.verdict == Verdict::Rejected && verdict.reason == Reason::NoWitness)
      closure.verdict = ClosureVerdict::Waiting;
    closure.weight = verdict.weight;
    closure.reason = toString(verdict.reason);
    closure.chi2 = verdict.chi2;
    closure.contradicted_by.clear();
    for (const int other : verdict.contradicted_by)
      if (static_cast<std::size_t>(other) >= chains)
        closure.contradicted_by.push_back(ids[static_cast<std::size_t>(other) - chains]);
  }
}

// Chi-square of six degrees of freedom at 99.9 %; of fewer where the information leaves directions free, which errs towards
// keeping.
constexpr double kInnovationLimit = 22.458;

/// The cost of all other edges where the poses stood before: they were relaxed with them.
double standingCost(const Solution<3>& with, const Problem<3>& problem, std::size_t edge) {
  Problem<3> alone;
  alone.poses = {problem.poses[static_cast<std::size_t>(problem.edges[edge].from)],
                 problem.poses[static_cast<std::size_t>(problem.edges[edge].to)]};
  alone.edges = {problem.edges[edge]};
  alone.edges[0].from = 0;
  alone.edges[0].to = 1;
  return with.cost_before - cost(alone, alone.poses, Objective::Geodesic);
}

/// Was any accepted closure made to wait?
bool makeWait(const Problem<3>& problem, std::size_t chains, const Parameters& parameters,
              std::map<ClosureId, Closure>& closures) {
  std::vector<Way> ways;
  std::size_t e = chains;
  for (auto& [id, closure] : closures) {
    const int a = problem.edges[e].from, b = problem.edges[e].to;
    ++e;
    if (closure.verdict == ClosureVerdict::Accepted) ways.push_back({&closure, a, b});
  }
  bool any = false;
  for (const Way& way : ways) {
    Closure& closure = *way.closure;
    const bool may_act_alone =
        closure.kind == EdgeKind::Asserted || (closure.kind == EdgeKind::Stereo && closure.odometry_gate);
    if (may_act_alone || closure.a.session != closure.b.session) continue;
    const bool supported = std::any_of(ways.begin(), ways.end(), [&](const Way& other) {
      return other.closure != way.closure && std::min(other.a, other.b) < std::max(way.a, way.b) &&
             std::min(way.a, way.b) < std::max(other.a, other.b);
    });
    if (supported || !isLarge(problem, closure, way.a, way.b, parameters)) continue;
    closure.verdict = ClosureVerdict::Waiting;
    closure.weight = 0.0;
    closure.reason = "a large correction, and no second closure that agrees yet";
    any = true;
  }
  return any;
}

/// The paper's way, over what is accepted.
Solution<3> relaxAccepted(const Problem<3>& problem, std::size_t chains, const SolveOptions& options,
                          const std::map<ClosureId, Closure>& closures) {
  Problem<3> accepted;
  accepted.poses = problem.poses;
  accepted.edges.assign(problem.edges.begin(), problem.edges.begin() + static_cast<std::ptrdiff_t>(chains));
  std::size_t e = chains;
  for (const auto& [id, closure] : closures) {
    if (closure.weight > 0.0) accepted.edges.push_back(problem.edges[e]);
    ++e;
  }
  RelativePcgOptions wanted;
  wanted.iterations = options.iterations;
  wanted.progress = options.progress;
  return relaxRelative<3>(accepted, wanted);
}

}  // namespace

Solution<3> judge(const Problem<3>& problem, const Parameters& parameters, const SolveOptions& options,
                  std::map<ClosureId, Closure>& closures) {
  const std::size_t chains = problem.edges.size() - closures.size();
  RobustSolution<3> judged;
  if (parameters.robust) {
    judged = relaxRobust(problem, rolesOf(chains, closures), options);
    take(judged, chains, closures);
  } else {
    takeAll(closures);
  }
  const bool waiting = makeWait(problem, chains, parameters, closures);
  if (parameters.solver == "relative_pcg") return relaxAccepted(problem, chains, options, closures);
  if (parameters.robust && !waiting) return std::move(judged.solution);
  std::vector<double> weights(chains, 1.0);
  for (const auto& [id, closure] : closures) weights.push_back(closure.weight);
  return solve(problem, options, weights);
}

Addition judgeAddition(const Problem<3>& problem, const Parameters& parameters, const SolveOptions& options,
                       std::map<ClosureId, Closure>& closures) {
  const std::size_t chains = problem.edges.size() - closures.size();
  std::vector<double> weights(chains, 1.0);
  for (const auto& [id, closure] : closures) weights.push_back(closure.weight);
  Addition made;
  bool solved = false;
  std::size_t e = chains;
  for (auto& [id, closure] : closures) {
    const std::size_t edge = e++;
    if (closure.judged) continue;
    weights[edge] = 1.0;
    Solution<3> with = solve(problem, options, weights);
    // What one measurement more costs is the square of its innovation.
    const double innovation = with.cost - (solved ? made.solution.cost : standingCost(with, problem, edge));
    closure.chi2 = std::max(innovation, 0.0);
    const bool fits = closure.kind == EdgeKind::Asserted || !parameters.robust || closure.chi2 <= kInnovationLimit;
    closure.verdict = fits ? ClosureVerdict::Accepted : ClosureVerdict::Rejected;
    closure.weight = fits ? 1.0 : 0.0;
    closure.reason = fits ? "agrees with what is accepted" : "disagrees with what is accepted";
    if (fits && makeWait(problem, chains, parameters, closures)) {
      for (auto& [other, one] : closures)
        weights[chains + static_cast<std::size_t>(std::distance(closures.begin(), closures.find(other)))] = one.weight;
    }
    if (closure.weight > 0.0) {
      made.solution = std::move(with);
      solved = true;
    } else {
      weights[edge] = 0.0;
      made.disagreement = true;
    }
  }
  if (!solved) made.solution = solve(problem, options, weights);
  return made;
}

}  // namespace pose_graph
