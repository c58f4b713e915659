// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_base.hpp"

#include <map>
#include <optional>

#include "urban_nav/stored_results.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/deflate.hpp"
#include "urban_nav_store/edit_journal.hpp"
#include "urban_nav_store/stored_map.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_graph.hpp"

namespace urban_nav {

using urban_nav_core::Matrix6d;
using urban_nav_store::appendInteger;
using urban_nav_store::appendText;
using urban_nav_store::Edge;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr const char* kBaseStage = "edits.base";
constexpr std::size_t kMostBase = std::size_t{1} << 32;  // bytes

void appendBasePose(std::string& bytes, const urban_nav_core::Pose& pose) {
  for (int i = 0; i < 3; ++i) urban_nav_store::appendNumber(bytes, pose.t()[i]);
  for (const double value : {pose.q().w(), pose.q().x(), pose.q().y(), pose.q().z()})
    urban_nav_store::appendNumber(bytes, value);
}

urban_nav_core::Pose readBasePose(urban_nav_store::ByteReader& reader) {
  double v[7];
  for (double& value : v) value = reader.number();
  return urban_nav_core::Pose(Eigen::Quaterniond(v[3], v[4], v[5], v[6]), {v[0], v[1], v[2]});
}

std::vector<Edge> closureEdges(Store& store, const SessionId& id) {
  std::vector<Edge> edges;
  store.graph().forEachEdge(id, [&](const Edge& edge) {
    if (edge.kind != urban_nav_store::EdgeKind::Odometry && !urban_nav_store::isOfEdit(edge.source))
      edges.push_back(edge);
  });
  return edges;
}

std::string packSession(Store& store, const urban_nav_store::Session& session) {
  std::string bytes;
  const urban_nav_store::StoredTrajectory trajectory = readTrajectory(store, session);
  const std::vector<Matrix6d> covariances = readStoredCovariances(store, session.id).poses;
  const auto anchor = store.sessions().anchor(session.id);
  appendText(bytes, trajectory.map);
  appendInteger(bytes, anchor ? static_cast<std::uint64_t>(anchor->revision) : 0);
  appendBasePose(bytes, anchor ? anchor->T_map_odom : urban_nav_core::Pose());
  appendInteger(bytes, trajectory.T_map_base.size());
  for (std::size_t i = 0; i < trajectory.T_map_base.size(); ++i) {
    appendInteger(bytes, static_cast<std::uint64_t>(trajectory.T_map_base[i].stamp));
    appendBasePose(bytes, trajectory.T_map_base[i].pose);
    const Matrix6d covariance = i < covariances.size() ? covariances[i] : Matrix6d(Matrix6d::Zero());
    for (int k = 0; k < 36; ++k) urban_nav_store::appendNumber(bytes, covariance(k / 6, k % 6));
  }
  const std::vector<Edge> edges = closureEdges(store, session.id);
  appendInteger(bytes, edges.size());
  for (const Edge& edge : edges) {
    urban_nav_store::appendNumber(bytes, edge.weight);
    appendText(bytes, toString(edge.verdict));
    appendText(bytes, edge.reason);
    appendText(bytes, store.graph().evidence(edge).value_or(""));
  }
  const auto graph = urban_nav_store::TableStore<urban_nav_store::StoredGraph>(store).get({session.id, {}});
  appendInteger(bytes, graph ? 1 : 0);
  appendText(bytes, graph ? graph->file : "");
  return bytes;
}

void unpackSession(Store& store, const SessionId& id, urban_nav_store::ByteReader& reader) {
  urban_nav_store::Anchor anchor;
  anchor.session = id;
  anchor.map = reader.text();
  anchor.revision = static_cast<std::int64_t>(reader.integer());
  anchor.T_map_odom = readBasePose(reader);
  const std::uint64_t poses = reader.integer();
  for (std::uint64_t i = 0; i < poses && reader.ok(); ++i) {
    urban_nav_store::RelaxedPose pose;
    pose.stamp = static_cast<urban_nav_core::StampNs>(reader.integer());
    pose.T_map_base = readBasePose(reader);
    pose.revision = anchor.revision;
    for (int k = 0; k < 36; ++k) pose.covariance(k / 6, k % 6) = reader.number();
    if (reader.ok()) store.graph().put(id, pose);
  }
  if (reader.ok()) store.sessions().put(anchor);
  std::vector<Edge> edges = closureEdges(store, id);
  if (reader.integer() != edges.size() || !reader.ok())
    throw urban_nav_core::DataError(store.path(), "the map before its edits is damaged", "map with --store, or a copy");
  for (Edge& edge : edges) {
    edge.weight = reader.number();
    edge.verdict = urban_nav_core::parseClosureVerdict(reader.text()).value_or(edge.verdict);
    edge.reason = reader.text();
    const std::string evidence(reader.text());
    store.graph().put(edge);
    if (!evidence.empty()) store.graph().putEvidence(edge, evidence);
  }
  const bool has_graph = reader.integer() == 1;
  const std::string file(reader.text());
  urban_nav_store::TableStore<urban_nav_store::StoredGraph> graphs(store);
  if (has_graph) graphs.put({id, file});
  else graphs.remove({id, {}});
}

void removeEditEdges(Store& store, const SessionId& id) {
  std::vector<Edge> edges;
  store.graph().forEachEdge(id, [&](const Edge& edge) {
    if (urban_nav_store::isOfEdit(edge.source)) edges.push_back(edge);
  });
  for (const Edge& edge : edges) store.graph().remove(edge);
}

}  // namespace

void keepBase(Store& store) {
  for (const urban_nav_store::Session& session : store.sessions().all())
    store.states().put(session.id, kBaseStage, urban_nav_store::deflated(packSession(store, session)));
}

bool holdsBase(Store& store) {
  for (const urban_nav_store::Session& session : store.sessions().all())
    if (store.states().get(session.id, kBaseStage)) return true;
  return false;
}

void restoreBase(Store& store) {
  for (const urban_nav_store::Session& session : store.sessions().all()) {
    const std::optional<std::string> packed = store.states().get(session.id, kBaseStage);
    if (!packed) continue;
    removeEditEdges(store, session.id);
    const std::optional<std::string> bytes = urban_nav_store::inflated(*packed, kMostBase);
    urban_nav_store::ByteReader reader(bytes ? *bytes : std::string_view());
    unpackSession(store, session.id, reader);
    if (!reader.complete())
      throw urban_nav_core::DataError(store.path(), "the map before its edits is damaged",
                                      "map with --store, or a copy");
  }
}

void forgetBase(Store& store) {
  for (const urban_nav_store::Session& session : store.sessions().all()) store.states().remove(session.id, kBaseStage);
}

}  // namespace urban_nav
