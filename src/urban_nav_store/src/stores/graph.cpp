// SPDX-License-Identifier: BSD-3-Clause
#include "stores/graph.hpp"

#include "tables/graph_tables.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_store {

using urban_nav_core::StampNs;
using urban_nav_core::UserError;

namespace {

constexpr std::size_t kMostEvidence = std::size_t{1} << 29;

std::string nodeName(const SessionId& session, StampNs stamp) {
  return "node " + urban_nav_core::printStamp(stamp) + " of session " + session;
}

std::string edgeName(const Edge& edge) {
  return std::string(toString(edge.kind)) + " edge from " + nodeName(edge.a.session, edge.a.stamp) + " to " +
         nodeName(edge.b.session, edge.b.stamp);
}

/// Reads the rows of a session in an interval of stamps; only a whole session can be verified.
template <typename Row>
void readBetween(TableAccess& tables, Row& row, StampNs from, StampNs to, const std::function<void()>& visit) {
  const Table& table = declaredTable<Row>();
  if (from == GraphStore::kFirst && to == GraphStore::kLast) {
    tables.forEach(table, SessionId(row.session), AnyRow(row), visit);
  } else {
    tables.forEachBetween(table, AnyRow(row), from, to, visit);
  }
}

}  // namespace

bool operator==(const NodeRef& a, const NodeRef& b) { return a.session == b.session && a.stamp == b.stamp; }

void SqliteGraphStore::put(const SessionId& session, const Node& node) {
  tables_.put(declaredTable<NodeRow>(), unchanged(NodeRow{session, node}));
}

std::optional<Node> SqliteGraphStore::node(const NodeRef& ref) const {
  NodeRow row{ref.session, {}};
  row.node.stamp = ref.stamp;
  if (!tables_.find(declaredTable<NodeRow>(), AnyRow(row))) return std::nullopt;
  return row.node;
}

std::int64_t SqliteGraphStore::nodes(const SessionId& session) const {
  return tables_.count(declaredTable<NodeRow>(), session);
}

void SqliteGraphStore::forEachNode(const SessionId& session, const std::function<void(const Node&)>& take, Stamp from,
                                   Stamp to) const {
  NodeRow row{session, {}};
  readBetween(tables_, row, from, to, [&] { take(row.node); });
}

void SqliteGraphStore::put(const SessionId& session, const RelaxedPose& pose) {
  tables_.put(declaredTable<RelaxedRow>(), unchanged(RelaxedRow{session, pose}));
}

void SqliteGraphStore::forEachRelaxed(const SessionId& session, const std::function<void(const RelaxedPose&)>& take,
                                      Stamp from, Stamp to) const {
  RelaxedRow row{session, {}};
  readBetween(tables_, row, from, to, [&] { take(row.relaxed); });
}

void SqliteGraphStore::put(const Edge& edge) { tables_.put(declaredTable<EdgeRow>(), unchanged(EdgeRow{edge})); }

void SqliteGraphStore::remove(const Edge& edge) {
  const Table& edges = declaredTable<EdgeRow>();
  const Table& evidence = declaredTable<EvidenceRow>();
  tables_.remove(edges, unchanged(EdgeRow{edge}), edges.keys);
  tables_.remove(evidence, unchanged(EvidenceRow{edge, ""}), evidence.keys);
}

void SqliteGraphStore::forEachEdge(const SessionId& session_a, const std::function<void(const Edge&)>& take) const {
  EdgeRow row;
  tables_.forEach(declaredTable<EdgeRow>(), session_a, AnyRow(row), [&] { take(row.edge); });
}

void SqliteGraphStore::putEvidence(const Edge& edge, const std::string& bytes) {
  if (bytes.size() > kMostEvidence)
    throw UserError(tables_.connection().name(), "the evidence of the " + edgeName(edge) + " is too long",
                    "at most 512 MB");
  tables_.put(declaredTable<EvidenceRow>(), unchanged(EvidenceRow{edge, deflated(bytes)}));
}

std::optional<std::string> SqliteGraphStore::evidence(const Edge& edge) const {
  EvidenceRow row{edge, ""};
  if (!tables_.find(declaredTable<EvidenceRow>(), AnyRow(row))) return std::nullopt;
  std::optional<std::string> bytes = inflated(row.data, kMostEvidence);
  if (!bytes) tables_.connection().damaged("in table evidence, a piece of evidence cannot be unpacked");
  return bytes;
}

}  // namespace urban_nav_store
