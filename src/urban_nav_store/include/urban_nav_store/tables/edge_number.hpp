// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/graph_store.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Number by which users refer to an edge that closes a loop, permanent in the store.
struct EdgeNumber {
  Edge edge;  ///< only its key
  std::int64_t number = 0;
  static Table table() {
    Table table{"edge_number", 6};
    table.since = 9;
    table.kept_by_clear = true;
    table.of_graph = true;
    table.other_session = "session_b";
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session_a", edge.a.session);
    columns.integer("stamp_a_ns", edge.a.stamp);
    columns.text("session_b", edge.b.session);
    columns.integer("stamp_b_ns", edge.b.stamp);
    columns.word("kind", edge.kind, parseEdgeKind);
    columns.text("source", edge.source);
    columns.integer("number", number);
  }
};

}  // namespace urban_nav_store
