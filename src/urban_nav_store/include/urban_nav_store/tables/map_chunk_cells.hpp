// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Points of one chunk of the map (MapChunk) in one tile.
struct MapChunkCells {
  SessionId session;
  std::string tile;                   ///< "x,y", integers
  urban_nav_core::StampNs begin = 0;  ///< of the chunk
  std::int64_t cells = 0;
  std::string data;  ///< compressed, in the encoding of laser_mapper
  static Table table() {
    Table table{"chunk_cells", 3};
    table.since = 3;
    table.wide = true;
    table.of_graph = true;
    table.merge = MergeRule::DropDifferent;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("tile", tile);
    columns.integer("begin_ns", begin);
    columns.integer("cells", cells);
    columns.blob("data", data);
  }
};

}  // namespace urban_nav_store
