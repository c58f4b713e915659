// SPDX-License-Identifier: BSD-3-Clause
#include "map/previous_sessions.hpp"

#include <algorithm>
#include <map>

#include "map/store_keys.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/session/sessions.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

/// Returns the steps of a chain by their ends: fused ones if there are several sources, else of visual or laser
/// odometry.
std::map<StampNs, Edge> collectSteps(Store& store, const SessionId& id) {
  std::map<StampNs, Edge> steps;
  store.graph().forEachEdge(id, [&](const Edge& edge) {
    if (edge.kind != EdgeKind::Odometry || edge.b.session != id) return;
    if (edge.source == kVoStage || edge.source == kLoStage || edge.source == kFusionStage) {
      steps[edge.b.stamp] = edge;
    } else {
      steps.emplace(edge.b.stamp, edge);
    }
  });
  return steps;
}

SessionOdometry makeChain(Store& store, const SessionId& id) {
  SessionOdometry run;
  for (const urban_nav_store::Extrinsic& extrinsic : store.sessions().extrinsics(id))
    if (extrinsic.frame == urban_nav_core::frames::kStereoLeft) run.T_base_camera = extrinsic.T_base_frame;
  for (const urban_nav_store::Property& property : store.sessions().properties(id))
    if (property.name == urban_nav_registration::kCalibrationProperty) run.cameras = property.value;
  const std::map<StampNs, Edge> steps = collectSteps(store, id);
  store.graph().forEachNode(id, [&](const urban_nav_store::Node& node) {
    SmoothedFrame settled;
    settled.frame = static_cast<std::int64_t>(run.settled.size());
    settled.stamp = node.stamp;
    settled.T_odom_base = {node.T_odom_base, node.covariance_from_first};
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
      step.constants = node.constants;
    }
    run.settled.push_back(settled);
  });
  if (const std::optional<std::string> bytes = store.states().get(id, kForcesStage))
    run.forces = unpackForces(*bytes).value_or(std::vector<urban_nav_core::SpecificForce>());
  const auto add = [&](StampNs stamp, bool accepted) {
    OdometryFrame row;
    row.frame = static_cast<std::int64_t>(run.frames.size());
    row.stamp = stamp;
    row.accepted = accepted;
    run.frames.push_back(row);
  };
  store.inputs().forEach(id, [&](const urban_nav_store::InputEvent& event) {
    if (event.stream == kVoStream || event.stream == kLoStream) add(event.stamp, event.used);
  });
  if (run.frames.empty())  // a store without the order of inputs
    for (const SmoothedFrame& settled : run.settled) add(settled.stamp, true);
  return run;
}

}  // namespace

PreviousSessions readPreviousSessions(Store& store, const std::vector<SessionId>& without) {
  PreviousSessions result;
  for (const urban_nav_store::Session& session : store.sessions().all()) {
    if (std::find(without.begin(), without.end(), session.id) != without.end()) continue;
    SessionOdometry run = makeChain(store, session.id);
    if (run.settled.empty()) continue;
    run.input = session.name;
    result.ids.push_back(session.id);
    result.names.push_back(urban_nav_input::uniqueName(
        session.name.empty() ? session.id : urban_nav_input::plainName(session.name), result.names));
    result.runs.push_back(std::move(run));
    if (const auto anchor = store.sessions().anchor(session.id))
      result.revision = std::max(result.revision, anchor->revision);
  }
  return result;
}

bool holdsClosures(Store& store) {
  bool any = false;
  for (const urban_nav_store::Session& session : store.sessions().all())
    store.graph().forEachEdge(session.id, [&](const Edge& edge) { any = any || edge.kind != EdgeKind::Odometry; });
  return any;
}

}  // namespace urban_nav
