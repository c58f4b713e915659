// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/graph_store_export.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "pose_graph/stored_graph.hpp"
#include "topics/graph/graph_g2o.hpp"
#include "urban_nav_store/deflate.hpp"
#include "urban_nav_store/edit_journal.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_graph.hpp"

namespace urban_nav {

using pose_graph::Track;
using urban_nav_core::MetricClosure;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

SessionId toId(const GraphRun& run, const std::vector<SessionId>& ids, const std::string& name) {
  const auto place = std::find(run.sessions.begin(), run.sessions.end(), name);
  return ids[static_cast<std::size_t>(place - run.sessions.begin())];
}

/// Returns the row of closures.csv, and the evidence of the stage that measured the closure.
std::string toEvidence(const MetricClosure& closure, const ClosureAssessment& assessment) {
  return printClosureRows({closure}, {assessment}) + closure.evidence;
}

/// Returns the edge of a candidate without a transform; nullopt if it concerns another session.
std::optional<Edge> rejectedEdge(const GraphRun& run, const std::vector<SessionId>& ids, const MetricClosure& closure) {
  const auto known = [&](const std::string& name) {
    return std::find(run.sessions.begin(), run.sessions.end(), name) != run.sessions.end();
  };
  if (!known(closure.a.session) || !known(closure.b.session)) return std::nullopt;
  Edge edge;
  edge.a = {toId(run, ids, closure.a.session), closure.a.stamp};
  edge.b = {toId(run, ids, closure.b.session), closure.b.stamp};
  edge.kind = closure.method == urban_nav_core::ClosureMethod::Icp ? EdgeKind::Icp : EdgeKind::Stereo;
  edge.source = closure.source;
  edge.measured.T_a_b = closure.measured.T_a_b;
  edge.weight = 0.0;
  edge.verdict = urban_nav_core::ClosureVerdict::Rejected;
  return edge;
}

/// Stores a candidate without a transform, for its evidence only.
void putRejected(Store& store, const GraphRun& run, const std::vector<SessionId>& ids, const MetricClosure& closure,
                 const ClosureAssessment& assessment) {
  std::optional<Edge> edge = rejectedEdge(run, ids, closure);
  if (!edge) return;
  edge->reason = assessment.reason;
  store.graph().put(*edge);
  store.graph().putEvidence(*edge, toEvidence(closure, assessment));
}

/// Returns the edge of a closure of the graph.
Edge graphEdge(const GraphRun& run, const std::vector<SessionId>& ids, const pose_graph::Closure& closure) {
  Edge edge = pose_graph::toEdge(closure);
  edge.a.session = toId(run, ids, closure.a.session);
  edge.b.session = toId(run, ids, closure.b.session);
  return edge;
}

template <typename IsRemoved>
void removeClosures(Store& store, const SessionId& id, const IsRemoved& is_removed) {
  std::vector<Edge> earlier;
  store.graph().forEachEdge(id, [&](const Edge& edge) {
    if (edge.kind != EdgeKind::Odometry && is_removed(edge)) earlier.push_back(edge);
  });
  for (const Edge& edge : earlier) store.graph().remove(edge);
}

void putFile(Store& store, const SessionId& id, const GraphRun& run) {
  urban_nav_store::TableStore<urban_nav_store::StoredGraph>(store).put({id, urban_nav_store::deflated(graphG2o(run))});
}

}  // namespace

void storeRelaxation(Store& store, const std::vector<SessionId>& ids, const GraphRun& run, std::int64_t revision) {
  revision += run.relaxed.revision;
  for (std::size_t s = 0; s < ids.size(); ++s) {
    removeClosures(store, ids[s], [](const Edge& edge) { return urban_nav_store::isOfEdit(edge.source); });
    const Track* track = run.graph.track(run.sessions[s]);
    if (track == nullptr || track->stamps.empty()) continue;
    const urban_nav_core::Trajectory trajectory = run.trajectory(s);
    const std::vector<urban_nav_core::Matrix6d>& covariances = run.covariances[s];
    for (std::size_t i = 0; i < trajectory.size(); ++i) {
      urban_nav_store::RelaxedPose relaxed{trajectory[i].stamp, trajectory[i].pose, revision};
      if (i < covariances.size()) relaxed.covariance = covariances[i];
      store.graph().put(ids[s], relaxed);
    }
    store.sessions().put(urban_nav_store::Anchor{ids[s], ids[run.findMap(s)], revision,
                                                 trajectory.front().pose * track->odom.front().inverse()});
  }
  if (!ids.empty()) putFile(store, ids.front(), run);
  std::map<pose_graph::ClosureId, std::size_t> index_of;
  for (std::size_t i = 0; i < run.closures.size(); ++i) index_of[run.assessments[i].id] = i;
  const auto put = [&](pose_graph::ClosureId id, const pose_graph::Closure& closure) {
    const Edge edge = graphEdge(run, ids, closure);
    store.graph().put(edge);
    if (const auto index = index_of.find(id); index != index_of.end())
      store.graph().putEvidence(edge, toEvidence(run.closures[index->second], run.assessments[index->second]));
  };
  for (const auto& [id, closure] : run.graph.closures()) put(id, closure);
  for (std::size_t i = 0; i < run.rejected_by_hand.size(); ++i)
    put(-1 - static_cast<pose_graph::ClosureId>(i), run.rejected_by_hand[i]);
}

void exportGraph(Store& store, const std::vector<SessionId>& ids, const GraphRun& run, std::int64_t revision) {
  for (const SessionId& id : ids)
    removeClosures(store, id, [](const Edge& edge) { return edge.kind != EdgeKind::Asserted; });
  storeRelaxation(store, ids, run, revision);
  for (std::size_t i = 0; i < run.closures.size(); ++i)
    if (run.assessments[i].id == 0 && isMeasured(run.closures[i]))
      putRejected(store, run, ids, run.closures[i], run.assessments[i]);
  urban_nav_store::storeEdgeNumbers(store);
}

std::vector<std::int64_t> readClosureNumbers(Store& store, const std::vector<SessionId>& ids, const GraphRun& run) {
  const std::map<urban_nav_store::EdgeKey, std::int64_t> known = urban_nav_store::readEdgeNumbers(store);
  std::vector<std::int64_t> numbers(run.closures.size(), 0);
  for (std::size_t i = 0; i < run.closures.size(); ++i) {
    const pose_graph::ClosureId id = run.assessments[i].id;
    std::optional<Edge> edge;
    if (id == 0) edge = rejectedEdge(run, ids, run.closures[i]);
    else if (id < 0) edge = graphEdge(run, ids, run.rejected_by_hand.at(static_cast<std::size_t>(-1 - id)));
    else edge = graphEdge(run, ids, run.graph.closures().at(id));
    if (!edge) continue;
    if (const auto number = known.find(urban_nav_store::edgeKey(*edge)); number != known.end())
      numbers[i] = number->second;
  }
  return numbers;
}

}  // namespace urban_nav
