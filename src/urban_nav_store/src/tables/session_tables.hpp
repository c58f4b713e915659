// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/session_store.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

struct SessionRow {
  Session session;
  static Table table() {
    Table table{"session"};
    table.merge = MergeRule::CompleteInAll;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("id", session.id);
    columns.text("name", session.name);
    columns.text("robot", session.robot);
    columns.text("recording", session.recording);
    columns.integer("start_ns", session.start);
    columns.flag("complete", session.complete);
  }
};

struct AnchorRow {
  Anchor anchor;
  static Table table() {
    Table table{"anchor"};
    table.of_graph = true;
    table.merge = MergeRule::LatestRevision;
    table.other_session = "map";
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", anchor.session);
    columns.text("map", anchor.map);
    columns.integer("revision", anchor.revision);
    columns.pose(anchor.T_map_odom);
  }
};

struct ParameterRow {
  SessionId session;
  StoredParameter parameter;
  static Table table() { return Table{"parameter", 2}; }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("name", parameter.name);
    columns.text("value", parameter.value);
    columns.text("origin", parameter.origin);
  }
};

struct PropertyRow {
  SessionId session;
  Property property;
  static Table table() { return Table{"property", 2}; }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("name", property.name);
    columns.text("value", property.value);
  }
};

struct ExtrinsicRow {
  SessionId session;
  Extrinsic extrinsic;
  static Table table() { return Table{"extrinsic", 2}; }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("frame", extrinsic.frame);
    columns.pose(extrinsic.T_base_frame);
  }
};

}  // namespace urban_nav_store
