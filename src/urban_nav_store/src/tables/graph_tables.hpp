// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/graph_store.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

struct NodeRow {
  SessionId session;
  Node node;
  static Table table() { return Table{"node", 2}; }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("stamp_ns", node.stamp);
    columns.pose(node.T_odom_base);
    columns.word("status", node.status, urban_nav_core::parseHealth);
    columns.matrix6("covariance", node.covariance);
    columns.matrix6("drift", node.drift_covariance);
    columns.since(6);
    columns.constants("constants", node.constants);
    columns.since(7);
    columns.matrix6("from_first", node.covariance_from_first);
  }
};

struct RelaxedRow {
  SessionId session;
  RelaxedPose relaxed;
  static Table table() {
    Table table{"relaxed", 2};
    table.of_graph = true;
    table.merge = MergeRule::LatestRevision;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("stamp_ns", relaxed.stamp);
    columns.pose(relaxed.T_map_base);
    columns.integer("revision", relaxed.revision);
    columns.since(7);
    columns.matrix6("covariance", relaxed.covariance);
  }
};

/// Returns nullopt for words that are not stored for edges.
inline std::optional<urban_nav_core::ClosureVerdict> parseEdgeVerdict(std::string_view word) {
  const auto verdict = urban_nav_core::parseClosureVerdict(word);
  return verdict == urban_nav_core::ClosureVerdict::Degenerate ? std::nullopt : verdict;
}

/// Key of edges and of their evidence.
inline void edgeKey(Columns& columns, Edge& edge) {
  columns.text("session_a", edge.a.session);
  columns.integer("stamp_a_ns", edge.a.stamp);
  columns.text("session_b", edge.b.session);
  columns.integer("stamp_b_ns", edge.b.stamp);
  columns.word("kind", edge.kind, parseEdgeKind);
  columns.text("source", edge.source);
}

struct EdgeRow {
  Edge edge;
  static Table table() {
    Table table{"edge", 6};
    table.other_session = "session_b";
    return table;
  }
  void columns(Columns& columns) {
    edgeKey(columns, edge);
    columns.pose(edge.measured.T_a_b);
    columns.matrix6("information", edge.measured.information);
    columns.real("weight", edge.weight);
    columns.word("verdict", edge.verdict, parseEdgeVerdict);
    columns.text("reason", edge.reason);
  }
};

struct EvidenceRow {
  Edge edge;  ///< only its key
  std::string data;
  static Table table() {
    Table table{"evidence", 6};
    table.wide = true;
    table.of_graph = true;
    table.other_session = "session_b";
    return table;
  }
  void columns(Columns& columns) {
    edgeKey(columns, edge);
    columns.blob("data", data);
  }
};

}  // namespace urban_nav_store
