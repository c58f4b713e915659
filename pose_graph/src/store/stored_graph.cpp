// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/stored_graph.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "pose_graph/ground_views.hpp"
#include "urban_nav_store/edit_journal.hpp"
#include "urban_nav_store/forces_state.hpp"
#include "urban_nav_store/stored_fixes.hpp"

namespace pose_graph {

using urban_nav_core::RelativePose;
using urban_nav_store::Node;
using urban_nav_store::Store;
using StoredEdge = urban_nav_store::Edge;

namespace {

constexpr const char* kGate = "odometry gate: passed\n";

/// Returns the steps of a session. A node's covariances are those of the motion from the previous node; the transform
/// is stored in the edge between the two, if it was measured.
std::vector<RelativePose> collectSteps(Store& store, const SessionId& session,
                                       const std::map<StampNs, StoredEdge>& edges) {
  std::vector<RelativePose> steps;
  StampNs before = 0;
  store.graph().forEachNode(session, [&](const Node& node) {
    const auto edge = edges.find(before);
    before = node.stamp;
    if (edge == edges.end() || edge->second.b.stamp != node.stamp) return;
    RelativePose step;
    step.from = edge->first;
    step.to = node.stamp;
    step.T_from_to = edge->second.measured.T_a_b;
    step.covariance = node.covariance;
    step.drift_covariance = node.drift_covariance;
    step.constants = node.constants;
    step.status.health = node.status;
    step.source = edge->second.source;
    steps.push_back(std::move(step));
  });
  return steps;
}

Closure toClosure(const StoredEdge& edge) {
  Closure closure;
  closure.a = edge.a;
  closure.b = edge.b;
  closure.kind = edge.kind;
  closure.source = edge.source;
  closure.measured = edge.measured;
  return closure;
}

bool isSameClosure(const StoredEdge& edge, const Closure& closure) {
  return edge.a == closure.a && edge.b == closure.b && edge.kind == closure.kind && edge.source == closure.source;
}

/// Removes closures rejected by edits and steps cut by edits, and marks closures confirmed manually. Closures added by
/// edits are among the stored ones.
void applyEdits(const std::vector<urban_nav_store::StoredEdit>& edits, StoredGraph& graph) {
  std::vector<Closure> closures;
  for (Closure& closure : graph.closures) {
    const auto verdict = std::find_if(edits.rbegin(), edits.rend(), [&](const urban_nav_store::StoredEdit& edit) {
      return (edit.action == "reject" || edit.action == "accept") && isSameClosure(edit.edge, closure);
    });
    if (verdict != edits.rend() && verdict->action == "reject") continue;
    closure.by_hand = verdict != edits.rend() || urban_nav_store::isOfEdit(closure.source);
    closures.push_back(std::move(closure));
  }
  graph.closures = std::move(closures);
  for (const urban_nav_store::StoredEdit& edit : edits)
    for (StoredGraph::Chain& chain : graph.chains)
      if (edit.action == "cut" && edit.session == chain.session.id)
        chain.steps.erase(std::remove_if(chain.steps.begin(), chain.steps.end(),
                                         [&](const RelativePose& step) {
                                           return step.from <= edit.edge.a.stamp && step.to > edit.edge.a.stamp;
                                         }),
                          chain.steps.end());
}

auto orderKey(const Closure& closure) {
  return std::make_tuple(std::max(closure.a.stamp, closure.b.stamp), closure.a.stamp, closure.a.session,
                         closure.b.session, closure.kind, closure.source);
}

}  // namespace

StoredGraph readGraph(Store& store) {
  StoredGraph made;
  std::set<SessionId> known;
  for (const urban_nav_store::Session& session : store.sessions().all()) {
    known.insert(session.id);
    std::map<StampNs, StoredEdge> steps;
    store.graph().forEachEdge(session.id, [&](const StoredEdge& edge) {
      if (edge.kind == EdgeKind::Odometry) {
        if (edge.b.session == session.id) steps.emplace(edge.a.stamp, edge);
        return;
      }
      if (edge.measured.information.isZero(0.0)) return;
      made.closures.push_back(toClosure(edge));
      made.closures.back().odometry_gate = passedOdometryGate(store.graph().evidence(edge).value_or(""));
    });
    made.chains.push_back({session,
                           collectSteps(store, session.id, steps),
                           {},
                           readGround(store, session.id),
                           urban_nav_store::readFixes(store, session.id)});
    if (const auto forces = store.states().get(session.id, urban_nav_store::kForcesStage))
      made.chains.back().forces = urban_nav_store::unpackForces(*forces).value_or(std::vector<SpecificForce>());
    store.graph().forEachRelaxed(session.id, [&](const urban_nav_store::RelaxedPose& pose) {
      made.revision = std::max(made.revision, pose.revision);
    });
    if (const auto anchor = store.sessions().anchor(session.id))
      made.revision = std::max(made.revision, anchor->revision);
  }
  const auto strange = [&](const Closure& closure) {
    return known.count(closure.a.session) == 0 || known.count(closure.b.session) == 0;
  };
  made.closures.erase(std::remove_if(made.closures.begin(), made.closures.end(), strange), made.closures.end());
  applyEdits(urban_nav_store::EditJournal(store).standing(), made);
  std::sort(made.closures.begin(), made.closures.end(),
            [](const Closure& a, const Closure& b) { return orderKey(a) < orderKey(b); });
  return made;
}

std::string toEvidence(bool odometry_gate) { return odometry_gate ? kGate : ""; }

std::string toEvidence(const urban_nav_core::MetricClosure& closure) {
  return toEvidence(closure.odometry_gate) + "method: " + toString(closure.method) +
         "\nprobability of the places being one: " + std::to_string(closure.probability) + "\n" + closure.evidence;
}

bool passedOdometryGate(const std::string& evidence) { return evidence.rfind(kGate, 0) == 0; }

std::vector<urban_nav_store::StoredParameter> listParameters(const Parameters& parameters) {
  std::vector<urban_nav_store::StoredParameter> made;
  for (const urban_nav_core::RowInfo& row : table().rows())
    made.push_back({urban_nav_core::fullName(table().stage(), row.name),
                    urban_nav_core::printValue(table().get(parameters, row.name)), ""});
  return made;
}

StoredEdge toEdge(const Closure& closure) {
  StoredEdge edge;
  edge.a = closure.a;
  edge.b = closure.b;
  edge.kind = closure.kind;
  edge.source = closure.source;
  edge.measured = closure.measured;
  edge.weight = closure.weight;
  edge.verdict = closure.verdict;
  edge.reason = closure.reason;
  return edge;
}

}  // namespace pose_graph
