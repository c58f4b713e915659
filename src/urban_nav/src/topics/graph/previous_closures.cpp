// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/previous_closures.hpp"

#include <map>
#include <optional>
#include <string_view>

#include "loop_metric/evidence.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

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

}  // namespace urban_nav
