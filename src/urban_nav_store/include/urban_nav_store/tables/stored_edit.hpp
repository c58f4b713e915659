// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/graph_store.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Change that a user made to the measurements of the graph: a row of the journal.
struct StoredEdit {
  SessionId session;        ///< session of the closure's later pose
  std::int64_t number = 0;  ///< from 1, in order of creation
  std::string action;       ///< "reject", "accept", "remove", "measure", "assert", "pin", "cut", "origin"
  std::string arguments;    ///< arguments of the action, quoted for a shell; empty for a closure's number
  /// reject, accept, remove: key of the closure; measure, assert: closure with its measurement; otherwise both poses
  /// are the pose concerned (cut: the last one before the cut).
  Edge edge;
  Eigen::Vector3d p_base = Eigen::Vector3d::Zero(), p_map = Eigen::Vector3d::Zero();  ///< pin: the point, m
  double sigma = 0.0;                                                                 ///< pin: of p_map, each axis, m
  std::string evidence;                                                               ///< measure: of the closure
  bool undone = false;
  bool dropped = false;  ///< undone and followed by another edit: cannot be redone
  static Table table() {
    Table table{"edit", 2};
    table.since = 9;
    table.wide = true;
    table.kept_by_clear = true;
    table.other_session = "session_a";
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("number", number);
    columns.text("action", action);
    columns.text("arguments", arguments);
    columns.text("session_a", edge.a.session);
    columns.integer("stamp_a_ns", edge.a.stamp);
    columns.text("session_b", edge.b.session);
    columns.integer("stamp_b_ns", edge.b.stamp);
    columns.word("kind", edge.kind, parseEdgeKind);
    columns.text("source", edge.source);
    columns.pose(edge.measured.T_a_b);
    columns.matrix6("information", edge.measured.information);
    constexpr const char* kNames[] = {"point_x", "point_y", "point_z", "map_x", "map_y", "map_z"};
    for (int i = 0; i < 3; ++i) columns.real(kNames[i], p_base[i]);
    for (int i = 0; i < 3; ++i) columns.real(kNames[3 + i], p_map[i]);
    columns.real("sigma", sigma);
    columns.blob("evidence", evidence);
    columns.flag("undone", undone);
    columns.flag("dropped", dropped);
  }
};

}  // namespace urban_nav_store
