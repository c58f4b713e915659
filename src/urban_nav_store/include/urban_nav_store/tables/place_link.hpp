// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Two poses at one place by the verdict of geometry, which place recognition learns from.
struct PlaceLink {
  SessionId session;  ///< of the later pose
  urban_nav_core::StampNs stamp = 0;
  SessionId earlier;  ///< session of the earlier pose, may be the same
  urban_nav_core::StampNs earlier_stamp = 0;
  double metres = 0.0;              ///< between the poses
  std::int64_t same_direction = 1;  ///< of both drives; 0: opposite
  std::int64_t accepted = 1;        ///< 0: withdrawn
  std::int64_t revision = 0;        ///< 0: by the stage that measured the transform; 1: by the pose graph

  static Table table() {
    Table table{"place_link", 4};
    table.since = 13;
    table.of_graph = true;
    table.merge = MergeRule::LatestRevision;
    table.other_session = "earlier";
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("stamp_ns", stamp);
    columns.text("earlier", earlier);
    columns.integer("earlier_stamp_ns", earlier_stamp);
    columns.real("metres", metres);
    columns.integer("same_direction", same_direction);
    columns.integer("accepted", accepted);
    columns.integer("revision", revision);
  }
};

}  // namespace urban_nav_store
