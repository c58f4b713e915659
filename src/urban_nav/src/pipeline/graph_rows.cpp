// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/graph_rows.hpp"

#include <algorithm>

namespace urban_nav {

using pose_graph::Track;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

SessionId idOf(const GraphRun& run, const std::vector<SessionId>& ids, const std::string& name) {
  const auto place = std::find(run.sessions.begin(), run.sessions.end(), name);
  return ids[static_cast<std::size_t>(place - run.sessions.begin())];
}

void removeClosures(Store& store, const SessionId& id) {
  std::vector<Edge> earlier;
  store.graph().forEachEdge(id, [&](const Edge& edge) {
    if (edge.kind != EdgeKind::Odometry && edge.kind != EdgeKind::Asserted) earlier.push_back(edge);
  });
  for (const Edge& edge : earlier) store.graph().remove(edge);
}

}  // namespace

void putGraph(Store& store, const std::vector<SessionId>& ids, const GraphRun& run) {
  for (std::size_t s = 0; s < ids.size(); ++s) {
    removeClosures(store, ids[s]);
    const Track* track = run.graph.track(run.sessions[s]);
    if (track == nullptr || track->stamps.empty()) continue;
    for (std::size_t i = 0; i < track->stamps.size(); ++i)
      store.graph().put(ids[s], urban_nav_store::RelaxedPose{track->stamps[i], track->map[i], run.relaxed.revision});
    const SessionId map = run.joined(s) ? ids.front() : ids[s];
    store.sessions().put(
        urban_nav_store::Anchor{ids[s], map, run.relaxed.revision, track->map.front() * track->odom.front().inverse()});
  }
  for (const auto& [id, closure] : run.graph.closures()) {
    Edge edge;
    edge.a = {idOf(run, ids, closure.a.session), closure.a.stamp};
    edge.b = {idOf(run, ids, closure.b.session), closure.b.stamp};
    edge.kind = closure.kind;
    edge.source = closure.source;
    edge.measured = closure.measured;
    edge.weight = closure.weight;
    edge.verdict = closure.verdict;
    edge.reason = closure.reason;
    store.graph().put(edge);
  }
}

}  // namespace urban_nav
