// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/keyframe_store.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Scans of one laser in one second, compressed (blocks/scan_block.hpp).
struct ScanBlockRow {
  SessionId session;
  std::string laser;
  std::int64_t second = 0;
  std::int64_t scans = 0;
  std::string data;
  static Table table() {
    Table table{"scan", 3};
    table.wide = true;
    table.kept_by_clear = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("laser", laser);
    columns.integer("second", second);
    columns.integer("scans", scans);
    columns.blob("data", data);
  }
};

struct KeyframeRow {
  SessionId session;
  std::string camera;
  StoredKeyframe keyframe;
  static Table table() {
    Table table{"keyframe", 3};
    table.since = 2;
    table.wide = true;
    table.kept_by_clear = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("camera", camera);
    columns.integer("stamp_ns", keyframe.stamp);
    columns.blob("image", keyframe.image);
    columns.blob("features", keyframe.features);
  }
};

/// Block of input events, compressed (blocks/event_block.hpp).
struct InputBlockRow {
  SessionId session;
  std::int64_t block = 0;
  std::int64_t events = 0;
  std::string data;
  static Table table() {
    Table table{"input", 2};
    table.wide = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("block", block);
    columns.integer("events", events);
    columns.blob("data", data);
  }
};

/// Part of a stage's state, compressed.
struct StatePartRow {
  SessionId session;
  std::string stage;
  std::int64_t part = 0;
  std::int64_t parts = 0;
  std::string data;
  static Table table() {
    Table table{"state", 3};
    table.wide = true;
    table.merge = MergeRule::DropDifferent;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("stage", stage);
    columns.integer("part", part);
    columns.integer("parts", parts);
    columns.blob("data", data);
  }
};

}  // namespace urban_nav_store
