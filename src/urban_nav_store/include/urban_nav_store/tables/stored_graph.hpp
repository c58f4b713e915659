// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Relaxed pose graph of several sessions as a file for other programs.
struct StoredGraph {
  SessionId session;  ///< first session of the graph
  std::string file;   ///< graph.g2o, compressed
  static Table table() {
    Table table{"graph_file"};
    table.since = 7;
    table.wide = true;
    table.of_graph = true;
    table.merge = MergeRule::DropDifferent;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.blob("file", file);
  }
};

}  // namespace urban_nav_store
