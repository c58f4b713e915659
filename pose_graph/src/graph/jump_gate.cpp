// SPDX-License-Identifier: BSD-3-Clause
#include "graph/jump_gate.hpp"

#include <algorithm>

#include "pose_graph/graph_file.hpp"
#include "solve/normal_equations.hpp"

namespace pose_graph {

namespace {

struct Way {
  Closure* closure;
  int first, last;  // numbers of poses
  bool same_track;
};

// Odometry's own word for what the closure measures.
bool isLarge(const Problem<3>& problem, const Closure& closure, int a, int b, const Parameters& parameters) {
  const Pose T_a_b =
      poseOf(problem.poses[static_cast<std::size_t>(a)]).inverse() * poseOf(problem.poses[static_cast<std::size_t>(b)]);
  return distanceBetween(T_a_b, closure.measured.T_a_b) > parameters.jump_distance ||
         angleBetween(T_a_b, closure.measured.T_a_b) > parameters.jump_angle * 3.14159265358979323846 / 180.0;
}

}  // namespace

Solution<3> judge(const Problem<3>& problem, const Parameters& parameters, const SolveOptions& options,
                  const std::vector<Track>& tracks, std::map<ClosureId, Closure>& closures) {
  const std::size_t chains = problem.edges.size() - closures.size();
  std::vector<double> weights(problem.edges.size(), 1.0);
  for (auto& [id, closure] : closures) {
    closure.verdict = EdgeVerdict::Accepted;
    closure.weight = 1.0;
    closure.reason = "taken as it is";
  }
  (void)tracks;
  std::vector<Way> ways;
  std::size_t e = chains;
  for (auto& [id, closure] : closures) {
    const int a = problem.edges[e].from, b = problem.edges[e].to;
    ++e;
    if (closure.verdict == EdgeVerdict::Accepted)
      ways.push_back({&closure, std::min(a, b), std::max(a, b), closure.a.session == closure.b.session});
  }
  bool any = false;
  for (const Way& way : ways) {
    Closure& closure = *way.closure;
    if (closure.kind == EdgeKind::Asserted || (closure.kind == EdgeKind::Stereo && closure.odometry_gate) ||
        !way.same_track)
      continue;
    const bool supported = std::any_of(ways.begin(), ways.end(), [&](const Way& other) {
      return other.closure != way.closure && other.first < way.last && way.first < other.last;
    });
    const bool a_first = closure.a.stamp < closure.b.stamp;
    if (supported ||
        !isLarge(problem, closure, a_first ? way.first : way.last, a_first ? way.last : way.first, parameters))
      continue;
    closure.verdict = EdgeVerdict::Waiting;
    closure.weight = 0.0;
    closure.reason = "a large correction, and no second closure that agrees yet";
    any = true;
  }
  (void)any;
  e = chains;
  for (const auto& [id, closure] : closures) weights[e++] = closure.weight;
  return solve(problem, options, weights);
}

std::vector<int> partsOf(const std::vector<Track>&, const PoseGraph& graph) {
  Problem<3> joined = graph.problem();
  const std::vector<double> weights = graph.weights();
  std::size_t kept = 0;
  for (std::size_t e = 0; e < joined.edges.size(); ++e)
    if (weights[e] > 0.0) joined.edges[kept++] = joined.edges[e];
  joined.edges.resize(kept);
  return unknownsOf(joined).component;
}

}  // namespace pose_graph
