// SPDX-License-Identifier: BSD-3-Clause
#include "graph/jump_gate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "pose_graph/ceres.hpp"
#include "pose_graph/graph_file.hpp"
#include "pose_graph/relative_pcg.hpp"
#include "pose_graph/robust.hpp"

namespace pose_graph {

namespace {

/// An accepted closure and where its ends are.
struct Way {
  Closure* closure;
  Place a, b;
};
/// What is known of T_a_b without it.
using Known = std::function<Pose(const Way&)>;

bool isLarge(const Closure& closure, const Pose& T_a_b, const Parameters& parameters) {
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

// Beyond this many times the limit, ten in standard deviations, the linear prediction of an innovation is enough: what
// relaxation finds is within a few times of it, even where a large loop is bent.
constexpr double kHopeless = 100.0;

/// Those of the accepted closures that have to wait, and do.
std::vector<ClosureId> makeWait(const std::vector<Way>& ways, const Known& T_a_b, const Parameters& parameters) {
  std::vector<ClosureId> made;
  for (const Way& way : ways) {
    Closure& closure = *way.closure;
    const bool may_act_alone =
        closure.kind == EdgeKind::Asserted || (closure.kind == EdgeKind::Stereo && closure.odometry_gate);
    if (may_act_alone || closure.a.session != closure.b.session || !isLarge(closure, T_a_b(way), parameters)) continue;
    const bool supported = std::any_of(ways.begin(), ways.end(), [&](const Way& other) {
      return other.closure != way.closure && std::min(other.a, other.b) < std::max(way.a, way.b) &&
             std::min(way.a, way.b) < std::max(other.a, other.b);
    });
    if (supported) continue;
    closure.verdict = ClosureVerdict::Waiting;
    closure.weight = 0.0;
    closure.reason = "a large correction, and no second closure that agrees yet";
    made.push_back(closure.id);
  }
  return made;
}

bool makeWait(const Problem<3>& problem, std::size_t chains, const Parameters& parameters,
              std::map<ClosureId, Closure>& closures) {
  std::vector<Way> ways;
  std::size_t e = chains;
  for (auto& [id, closure] : closures) {
    const Edge<3>& edge = problem.edges[e++];
    if (closure.verdict == ClosureVerdict::Accepted)
      ways.push_back({&closure, {0, static_cast<std::size_t>(edge.from)}, {0, static_cast<std::size_t>(edge.to)}});
  }
  const Known by_poses = [&problem](const Way& way) {
    return poseOf(problem.poses[way.a.second]).inverse() * poseOf(problem.poses[way.b.second]);
  };
  return !makeWait(ways, by_poses, parameters).empty();
}

std::vector<ClosureId> makeWait(const Ground& ground, const std::map<ClosureId, Bond>& bonds,
                                const Parameters& parameters, std::map<ClosureId, Closure>& closures) {
  std::vector<Way> ways;
  auto bond = bonds.begin();
  for (auto& [id, closure] : closures) {
    if (closure.verdict == ClosureVerdict::Accepted) ways.push_back({&closure, bond->second.a, bond->second.b});
    ++bond;
  }
  const Known by_map = [&ground](const Way& way) {
    return poseOf(ground.pose(way.a)).inverse() * poseOf(ground.pose(way.b));
  };
  return makeWait(ways, by_map, parameters);
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
  const bool by_ceres = parameters.solver == "ceres";
  if (parameters.robust && !waiting && !by_ceres) return std::move(judged.solution);
  std::vector<double> weights(chains, 1.0);
  for (const auto& [id, closure] : closures) weights.push_back(closure.weight);
  return by_ceres ? solveByCeres(problem, options, weights) : solve(problem, options, weights);
}

Addition judgeAddition(LiveCore& core, const Ground& ground, const Parameters& parameters,
                       const std::map<ClosureId, Bond>& bonds, std::map<ClosureId, Closure>& closures) {
  Addition made;
  made.cost_before = core.cost();
  for (auto& [id, closure] : closures) {
    if (closure.judged) continue;
    const bool doubted = closure.kind != EdgeKind::Asserted && parameters.robust;
    const LiveCore::Offer offer = core.offer(ground, bonds.at(id), doubted ? kHopeless * kInnovationLimit : INFINITY);
    // What one measurement more costs is the square of its innovation.
    closure.chi2 = std::max(offer.innovation, 0.0);
    const bool fits = !doubted || closure.chi2 <= kInnovationLimit;
    closure.verdict = fits ? ClosureVerdict::Accepted : ClosureVerdict::Rejected;
    closure.weight = fits ? 1.0 : 0.0;
    closure.reason = fits ? "agrees with what is accepted" : "disagrees with what is accepted";
    if (fits) {
      for (const ClosureId waiting : makeWait(ground, bonds, parameters, closures))
        if (waiting != id) made.others_wait = true;
    }
    if (closure.weight > 0.0) {
      made.cost_before = offer.before;
      core.keep();
    } else {
      core.takeBack();
      made.disagreement = true;
    }
  }
  return made;
}

}  // namespace pose_graph
