// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Points of a map in one tile of one of its levels of detail, or the list of all its tiles.
struct MapTile {
  SessionId session;        ///< first one of the map
  std::string tile;         ///< "level/x,y", integers; empty: the list of the tiles, written last
  std::int64_t points = 0;  ///< of the tile; of the list: of the map
  std::string data;         ///< compressed, in the encoding of laser_mapper
  static Table table() {
    Table table{"tile", 2};
    table.since = 11;
    table.wide = true;
    table.of_graph = true;
    table.merge = MergeRule::DropDifferent;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("tile", tile);
    columns.integer("points", points);
    columns.blob("data", data);
  }
};

}  // namespace urban_nav_store
