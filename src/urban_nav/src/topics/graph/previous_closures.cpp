// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/previous_closures.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "loop_metric/evidence.hpp"
#include "map/closure_rows.hpp"
#include "pose_graph/stored_graph.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/edit_journal.hpp"

namespace urban_nav {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureRow;
using urban_nav_core::MetricClosure;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

/// Returns the row of closures.csv at the beginning of the evidence of an edge; nullopt for other evidence.
std::optional<ClosureRow> findRow(Store& store, const Edge& edge) {
  const std::optional<std::string> evidence = store.graph().evidence(edge);
  if (!evidence) return std::nullopt;
  const std::string_view text = *evidence;
  const std::string_view row = text.substr(0, text.size() - loop_metric::evidenceIn(text).size());
  try {
    const std::vector<ClosureRow> rows = urban_nav_core::parseClosures(row, edge.source);
    if (rows.size() == 1) return rows.front();
  } catch (const urban_nav_core::UserError&) {
    // the evidence of another stage
  }
  return std::nullopt;
}

ClosureMethod toMethod(EdgeKind kind) {
  if (kind == EdgeKind::Stereo) return ClosureMethod::Stereo;
  return kind == EdgeKind::Icp ? ClosureMethod::Icp : ClosureMethod::None;
}

/// Returns whether a measured transform passed the odometry gate, according to its evidence.
bool passedGate(const std::string& evidence) {
  if (pose_graph::passedOdometryGate(evidence)) return true;
  const std::string_view its = loop_metric::evidenceIn(evidence);
  if (its.empty()) return false;
  const std::vector<urban_nav_registration::ClosureTest> gate = loop_metric::parseEvidence(its).gate;
  return std::any_of(gate.begin(), gate.end(), [](const urban_nav_registration::ClosureTest& test) {
    return test.passed && (test.name == "stereo_against_odometry" || test.name == "icp_against_odometry");
  });
}

/// Returns the closure as it was added, if stored, otherwise as it is in the graph.
MetricClosure toOffered(Store& store, const Edge& edge, const pose_graph::Closure& closure) {
  ClosureRow row;
  row.a.stamp = edge.a.stamp;
  row.b.stamp = edge.b.stamp;
  row.method = toMethod(edge.kind);
  row.T_a_b = edge.measured.T_a_b;
  if (const std::optional<ClosureRow> stored = findRow(store, edge)) row = *stored;
  row.a.session = closure.a.session;
  row.b.session = closure.b.session;
  row.where = edge.source;
  MetricClosure offered = toMetricClosure(row);
  const std::string evidence = store.graph().evidence(edge).value_or("");
  offered.evidence = loop_metric::evidenceIn(evidence);
  return offered;
}

}  // namespace

PreviousClosures closuresBetween(Store& store, const std::vector<SessionId>& ids,
                                 const std::vector<std::string>& names) {
  PreviousClosures result;
  std::map<SessionId, std::string> name;
  for (std::size_t i = 0; i < ids.size(); ++i) name[ids[i]] = names[i];
  for (const SessionId& id : ids) {
    std::vector<Edge> edges;
    store.graph().forEachEdge(id, [&](const Edge& edge) {
      if (edge.kind != EdgeKind::Odometry && name.count(edge.b.session) > 0 &&
          !urban_nav_store::isOfEdit(edge.source) &&
          !edge.measured.information.isZero(0.0))  // unmeasured edges are stored only for their evidence
        edges.push_back(edge);
    });
    for (const Edge& edge : edges) {
      pose_graph::Closure closure;
      closure.a = {name.at(edge.a.session), edge.a.stamp};
      closure.b = {name.at(edge.b.session), edge.b.stamp};
      closure.kind = edge.kind;
      closure.source = edge.source;
      closure.measured = edge.measured;
      if (closure.kind == EdgeKind::Plane) {
        result.planes.push_back(closure);
        continue;
      }
      closure.odometry_gate = passedGate(store.graph().evidence(edge).value_or(""));
      result.offered.push_back(toOffered(store, edge, closure));
      result.in_graph.push_back(closure);
    }
  }
  return result;
}

}  // namespace urban_nav
