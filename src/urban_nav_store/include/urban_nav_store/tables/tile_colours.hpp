// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Colours of the points of one tile of a map, in the order of the points.
struct TileColours {
  SessionId session;        ///< first one of the map
  std::string tile;         ///< "x,y", integers; empty: the colours of all tiles are complete
  std::string digest;       ///< of everything that the colours depend on
  std::int64_t points = 0;  ///< of the tile
  std::string data;  ///< compressed: red, green, blue, and whether each point is coloured, one array after another
  static Table table() {
    Table table{"tile_colours", 2};
    table.since = 10;
    table.wide = true;
    table.of_graph = true;
    table.merge = MergeRule::DropDifferent;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("tile", tile);
    columns.text("digest", digest);
    columns.integer("points", points);
    columns.blob("data", data);
  }
};

}  // namespace urban_nav_store
