// SPDX-License-Identifier: BSD-3-Clause
#include "stage/previous_sessions.hpp"

#include <algorithm>
#include <map>

#include "input/sessions.hpp"
#include "loop_metric/evidence.hpp"
#include "stage/store_keys.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

/// The steps of a chain by where they end: what visual odometry says, where several say something.
std::map<StampNs, Edge> collectSteps(Store& store, const SessionId& id) {
  std::map<StampNs, Edge> steps;
  store.graph().forEachEdge(id, [&](const Edge& edge) {
    if (edge.kind != EdgeKind::Odometry || edge.b.session != id) return;
    if (edge.source == kVoStage) {
      steps[edge.b.stamp] = edge;
    } else {
      steps.emplace(edge.b.stamp, edge);
    }
  });
  return steps;
}

VoRun makeChain(Store& store, const SessionId& id) {
  VoRun run;
  for (const urban_nav_store::Extrinsic& extrinsic : store.sessions().extrinsics(id))
    if (extrinsic.frame == urban_nav_core::frames::stereo_left) run.T_base_camera = extrinsic.T_base_frame;
  const std::map<StampNs, Edge> steps = collectSteps(store, id);
  store.graph().forEachNode(id, [&](const urban_nav_store::Node& node) {
    swf_vo::Settled settled;
    settled.frame = static_cast<swf_vo::FrameId>(run.settled.size());
    settled.stamp = node.stamp;
    settled.T_odom_base.pose = node.T_odom_base;
    settled.status.health = node.status;
    urban_nav_core::RelativePose& step = settled.from_previous;
    step.from = run.settled.empty() ? node.stamp : run.settled.back().stamp;
    step.to = node.stamp;
    if (!run.settled.empty()) {
      const auto edge = steps.find(node.stamp);
      step.T_from_to = edge != steps.end() && edge->second.a.stamp == step.from
                           ? edge->second.measured.T_a_b
                           : run.settled.back().T_odom_base.pose.inverse() * node.T_odom_base;
      step.covariance = node.covariance;
      step.drift_covariance = node.drift_covariance;
    }
    run.settled.push_back(settled);
  });
  if (const std::optional<std::string> bytes = store.states().get(id, kForcesStage))
    run.forces = unpackForces(*bytes).value_or(std::vector<urban_nav_core::SpecificForce>());
  const auto add = [&](StampNs stamp, bool accepted) {
    VoRow row;
    row.frame = static_cast<std::int64_t>(run.rows.size());
    row.stamp = stamp;
    row.accepted = accepted;
    run.rows.push_back(row);
  };
  store.inputs().forEach(id, [&](const urban_nav_store::InputEvent& event) {
    if (event.stream == kVoStream) add(event.stamp, event.used);
  });
  if (run.rows.empty())  // a store without the order of inputs
    for (const swf_vo::Settled& settled : run.settled) add(settled.stamp, true);
  return run;
}

std::string_view offerIn(std::string_view evidence) {
  return evidence.substr(0, evidence.size() - loop_metric::evidenceIn(evidence).size());
}

/// As it was offered where the store knows; else as it stands in the graph.
ClosureRow toRow(Store& store, const Edge& edge, const pose_graph::Closure& closure) {
  ClosureRow row;
  row.stamp_a = edge.a.stamp;
  row.stamp_b = edge.b.stamp;
  row.kind = edge.kind == EdgeKind::Stereo ? "stereo" : edge.kind == EdgeKind::Icp ? "icp" : "none";
  row.T_a_b = edge.measured.T_a_b;
  if (const std::optional<std::string> evidence = store.graph().evidence(edge)) {
    try {
      const std::vector<ClosureRow> rows = parseClosures(offerIn(*evidence), edge.source);
      if (rows.size() == 1) row = rows.front();
    } catch (const urban_nav_core::UserError&) {
      // evidence of another stage, in its own words
    }
  }
  row.session_a = closure.a.session;
  row.session_b = closure.b.session;
  row.where = edge.source;
  return row;
}

}  // namespace

PreviousSessions readPreviousSessions(Store& store, const std::vector<SessionId>& without) {
  PreviousSessions made;
  for (const urban_nav_store::Session& session : store.sessions().all()) {
    if (std::find(without.begin(), without.end(), session.id) != without.end()) continue;
    VoRun run = makeChain(store, session.id);
    if (run.settled.empty()) continue;
    run.input = session.name;
    made.ids.push_back(session.id);
    made.names.push_back(uniqueName(session.name.empty() ? session.id : plainName(session.name), made.names));
    made.runs.push_back(std::move(run));
    if (const auto anchor = store.sessions().anchor(session.id))
      made.revision = std::max(made.revision, anchor->revision);
  }
  return made;
}

std::vector<PreviousClosure> closuresBetween(Store& store, const std::vector<SessionId>& ids,
                                             const std::vector<std::string>& names) {
  std::vector<PreviousClosure> made;
  std::map<SessionId, std::string> name;
  for (std::size_t i = 0; i < ids.size(); ++i) name[ids[i]] = names[i];
  for (const SessionId& id : ids) {
    std::vector<Edge> edges;
    store.graph().forEachEdge(id, [&](const Edge& edge) {
      if (edge.kind != EdgeKind::Odometry && name.count(edge.b.session) > 0 &&
          !edge.measured.information.isZero(0.0))  // what was never measured is there for its evidence alone
        edges.push_back(edge);
    });
    for (const Edge& edge : edges) {
      pose_graph::Closure closure;
      closure.a = {name.at(edge.a.session), edge.a.stamp};
      closure.b = {name.at(edge.b.session), edge.b.stamp};
      closure.kind = edge.kind;
      closure.source = edge.source;
      closure.measured = edge.measured;
      made.push_back({toRow(store, edge, closure), closure});
    }
  }
  return made;
}

bool holdsClosures(Store& store) {
  bool any = false;
  for (const urban_nav_store::Session& session : store.sessions().all())
    store.graph().forEachEdge(session.id, [&](const Edge& edge) { any = any || edge.kind != EdgeKind::Odometry; });
  return any;
}

}  // namespace urban_nav
