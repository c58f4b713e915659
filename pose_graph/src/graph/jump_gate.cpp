// SPDX-License-Identifier: BSD-3-Clause
#include "graph/jump_gate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/robust.hpp"

namespace pose_graph {

namespace {

/// An accepted closure and the nodes that it joins.
struct AcceptedSpan {
  Closure* closure;
  NodeIndex a, b;
};
/// Returns T_a_b as estimated without the closure.
using RelativePoseEstimate = std::function<Pose(const AcceptedSpan&)>;

bool isLarge(const Closure& closure, const Pose& T_a_b, const Parameters& parameters) {
  return distanceBetween(T_a_b, closure.measured.T_a_b) > parameters.confirmation_distance ||
         angleBetween(T_a_b, closure.measured.T_a_b) > parameters.confirmation_angle * 3.14159265358979323846 / 180.0;
}

std::vector<EdgeRole> assignRoles(std::size_t chains, const std::map<ClosureId, Closure>& closures) {
  std::vector<EdgeRole> roles(chains, EdgeRole::Trusted);
  for (const auto& [id, closure] : closures)
    roles.push_back(isVouchedFor(closure) ? EdgeRole::Asserted : EdgeRole::Candidate);
  return roles;
}

void admitAll(std::map<ClosureId, Closure>& closures) {
  for (auto& [id, closure] : closures) {
    closure.verdict = ClosureVerdict::Accepted;
    closure.weight = 1.0;
    closure.reason = "accepted without selection";
  }
}

void take(const RobustSolution<3>& judged, std::size_t chains, std::map<ClosureId, Closure>& closures) {
  std::vector<ClosureId> ids;
  for (const auto& [id, closure] : closures) ids.push_back(id);
  std::size_t e = chains;
  for (auto& [id, closure] : closures) {
    const EdgeAssessment& verdict = judged.edges[e++];
    closure.verdict = verdict.verdict == ClosureVerdict::Accepted ? ClosureVerdict::Accepted : ClosureVerdict::Rejected;
    if (verdict.verdict == ClosureVerdict::Rejected && verdict.reason == Reason::NoWitness)
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

// Replaces slipped steps by the motion that closures imply.
std::vector<int> takeSlips(const RobustSolution<3>& selected, std::size_t chains, Problem<3>& problem) {
  std::vector<int> slipped;
  for (std::size_t e = 0; e < chains; ++e) {
    if (selected.edges[e].weight > 0.0) continue;
    Edge<3>& step = problem.edges[e];
    step.Z = selected.solution.poses[static_cast<std::size_t>(step.from)].inverse() *
             selected.solution.poses[static_cast<std::size_t>(step.to)];
    step.information *= kSlippedShare;
    slipped.push_back(static_cast<int>(e));
  }
  return slipped;
}

void rescale(const SelectionReport& selection, const std::vector<EdgeRole>& roles, Problem<3>& problem) {
  for (std::size_t e = 0; e < roles.size(); ++e) {
    if (roles[e] == EdgeRole::Trusted) problem.edges[e].information /= selection.odometry_factor;
    if (roles[e] == EdgeRole::Candidate) problem.edges[e].information /= selection.closure_factor;
  }
}

// Chi-square of six degrees of freedom at 99.9 %. With free directions there are fewer degrees of freedom, and the test
// is more tolerant.
constexpr double kInnovationLimit = 22.458;

// Factor of the limit (ten in standard deviations) above which the linear prediction of an innovation suffices: the
// relaxed innovation is within a few times of it, even for a bent large loop.
constexpr double kPredictionLimit = 100.0;

/// Whether two closures span a common part of the path.
bool overlap(const AcceptedSpan& a, const AcceptedSpan& b) {
  return std::min(a.a, a.b) < std::max(b.a, b.b) && std::min(b.a, b.b) < std::max(a.a, a.b);
}

// Limit of waiting closures tried together with a new one, the most likely first; each takes as long as the new one.
// Further ones are left to the batch.
constexpr std::size_t kTried = 3;

/// Sets unconfirmed closures with large corrections to waiting. Returns their ids.
std::vector<ClosureId> holdUnconfirmed(const std::vector<AcceptedSpan>& spans, const RelativePoseEstimate& T_a_b,
                                       const Parameters& parameters) {
  std::vector<ClosureId> made;
  for (const AcceptedSpan& span : spans) {
    Closure& closure = *span.closure;
    const bool may_act_alone = isVouchedFor(closure) || (closure.kind == EdgeKind::Stereo && closure.odometry_gate);
    if (may_act_alone || closure.a.session != closure.b.session || !isLarge(closure, T_a_b(span), parameters)) continue;
    const bool supported = std::any_of(spans.begin(), spans.end(), [&](const AcceptedSpan& other) {
      return other.closure != span.closure && overlap(other, span);
    });
    if (supported) continue;
    closure.verdict = ClosureVerdict::Waiting;
    closure.weight = 0.0;
    closure.reason = "large correction, not confirmed by a second closure yet";
    made.push_back(closure.id);
  }
  return made;
}

bool holdUnconfirmed(const Problem<3>& problem, std::size_t chains, const Parameters& parameters,
                     std::map<ClosureId, Closure>& closures) {
  std::vector<AcceptedSpan> spans;
  std::size_t e = chains;
  for (auto& [id, closure] : closures) {
    const Edge<3>& edge = problem.edges[e++];
    if (closure.verdict == ClosureVerdict::Accepted)
      spans.push_back({&closure, {0, static_cast<std::size_t>(edge.from)}, {0, static_cast<std::size_t>(edge.to)}});
  }
  const RelativePoseEstimate by_poses = [&problem](const AcceptedSpan& span) {
    return toPose(problem.poses[span.a.second]).inverse() * toPose(problem.poses[span.b.second]);
  };
  return !holdUnconfirmed(spans, by_poses, parameters).empty();
}

std::vector<ClosureId> holdUnconfirmed(const GraphView& view, const std::map<ClosureId, ClosureEdge>& closure_edges,
                                       const Parameters& parameters, std::map<ClosureId, Closure>& closures) {
  std::vector<AcceptedSpan> spans;
  auto closure_edge = closure_edges.begin();
  for (auto& [id, closure] : closures) {
    if (closure.verdict == ClosureVerdict::Accepted)
      spans.push_back({&closure, closure_edge->second.a, closure_edge->second.b});
    ++closure_edge;
  }
  const RelativePoseEstimate by_map = [&view](const AcceptedSpan& span) {
    return toPose(view.pose(span.a)).inverse() * toPose(view.pose(span.b));
  };
  return holdUnconfirmed(spans, by_map, parameters);
}

}  // namespace

Assessment assess(Problem<3>& problem, const Parameters& parameters, const SolveOptions& options,
                  const ReferenceSolver* reference, std::map<ClosureId, Closure>& closures) {
  const std::size_t chains = problem.edges.size() - closures.size();
  const std::vector<EdgeRole> roles = assignRoles(chains, closures);
  Assessment result;
  if (parameters.robust) {
    RobustSolution<3> selected = relaxSelected(problem, roles, options);
    take(selected, chains, closures);
    result.selection = selected.selection;
    result.slipped = takeSlips(selected, chains, problem);
    result.solution = std::move(selected.solution);
  } else {
    admitAll(closures);
  }
  const bool waiting = holdUnconfirmed(problem, chains, parameters, closures);
  const bool is_rescaled = result.selection.rescaled;
  if (is_rescaled) rescale(result.selection, roles, problem);
  if (parameters.robust && !waiting && !is_rescaled && reference == nullptr) return result;
  std::vector<double> weights(chains, 1.0);
  for (const auto& [id, closure] : closures) weights.push_back(closure.weight);
  if (reference == nullptr && is_rescaled) problem.poses = result.solution.poses;
  result.solution =
      reference != nullptr ? reference->solve(problem, options, weights) : solve(problem, options, weights);
  return result;
}

namespace {

/// Tests a closure against the core graph, in which it remains on trial. Returns whether it fits.
bool fits(IncrementalSolver& core, const GraphView& view, const Parameters& parameters, const ClosureEdge& closure_edge,
          Closure& closure, double& cost_before) {
  const bool is_tested = !isVouchedFor(closure) && parameters.robust;
  const IncrementalSolver::Offer offer =
      core.offer(view, closure_edge, is_tested ? kPredictionLimit * kInnovationLimit : INFINITY);
  // The cost of one additional measurement is its squared innovation.
  closure.chi2 = std::max(offer.innovation, 0.0);
  cost_before = offer.before;
  return !is_tested || closure.chi2 <= kInnovationLimit;
}

void accept(Closure& closure) {
  closure.verdict = ClosureVerdict::Accepted;
  closure.weight = 1.0;
  closure.reason = "consistent with the accepted edges";
}

/// Returns waiting closures that may confirm one on trial, in ascending order of their residuals with it.
std::vector<AcceptedSpan> findPartners(const AcceptedSpan& tried, const IncrementalSolver& core, const GraphView& view,
                                       const std::map<ClosureId, ClosureEdge>& closure_edges,
                                       std::map<ClosureId, Closure>& closures) {
  std::vector<std::pair<double, AcceptedSpan>> found;
  auto closure_edge = closure_edges.begin();
  for (auto& [id, closure] : closures) {
    const auto& [a, b, edge] = (closure_edge++)->second;
    const AcceptedSpan span{&closure, a, b};
    if (!closure.judged || closure.verdict != ClosureVerdict::Waiting || !overlap(span, tried)) continue;
    Problem<3> alone;
    alone.poses = {core.pose(view, a), core.pose(view, b)};
    alone.edges = {edge};
    alone.edges.back().from = 0;
    alone.edges.back().to = 1;
    found.emplace_back(cost(alone, alone.poses, Objective::Geodesic), span);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<AcceptedSpan> partners;
  for (const auto& [off, span] : found) partners.push_back(span);
  return partners;
}

}  // namespace

Addition evaluateAddition(IncrementalSolver& core, const GraphView& view, const Parameters& parameters,
                          const std::map<ClosureId, ClosureEdge>& closure_edges,
                          std::map<ClosureId, Closure>& closures) {
  Addition made;
  made.cost_before = core.cost();
  for (auto& [id, closure] : closures) {
    if (closure.judged) continue;
    double cost_before = 0.0;
    if (!fits(core, view, parameters, closure_edges.at(id), closure, cost_before)) {
      core.withdraw();
      closure.verdict = ClosureVerdict::Rejected;
      closure.weight = 0.0;
      closure.reason = "inconsistent with the accepted edges";
      made.disagreement = true;
      continue;
    }
    accept(closure);
    const std::vector<AcceptedSpan> partners =
        findPartners({&closure, closure_edges.at(id).a, closure_edges.at(id).b}, core, view, closure_edges, closures);
    for (std::size_t p = 0; p < std::min(partners.size(), kTried); ++p) {
      Closure& partner = *partners[p].closure;
      double ignored = 0.0;
      if (fits(core, view, parameters, closure_edges.at(partner.id), partner, ignored)) accept(partner);
      else core.withdraw();
    }
    for (const ClosureId waiting : holdUnconfirmed(view, closure_edges, parameters, closures))
      if (waiting != id) made.others_wait = true;
    if (closure.weight > 0.0) {
      made.cost_before = cost_before;
      made.provisional = made.provisional || parameters.robust;
      core.keep();
    } else {
      core.withdraw();
      // Waiting closures that were not tried may confirm it.
      made.disagreement = made.disagreement || partners.size() > kTried;
    }
  }
  return made;
}

}  // namespace pose_graph
