// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Laser scans of some seconds of a session, rendered into the map. Its points are rows of MapChunkCells.
struct MapChunk {
  SessionId session;
  urban_nav_core::StampNs begin = 0;  ///< beginning of the interval that the chunk covers
  urban_nav_core::StampNs end = 0;    ///< beginning of the next chunk
  std::string settings;               ///< digest of the parameters and extrinsics used for rendering
  std::int64_t revision = 0;          ///< of the poses: number of times that the chunk was rendered
  std::string poses;                  ///< along the chunk, in the encoding of laser_mapper
  std::string tiles;                  ///< tiles with points of the chunk, "x,y" separated by blanks
  std::int64_t beams = 0, mixed = 0, without_pose = 0, out_of_range = 0, cells = 0;
  static Table table() {
    Table table{"chunk", 2};
    table.since = 3;
    table.wide = true;
    table.of_graph = true;
    table.merge = MergeRule::DropDifferent;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("begin_ns", begin);
    columns.integer("end_ns", end);
    columns.text("settings", settings);
    columns.integer("revision", revision);
    columns.blob("poses", poses);
    columns.text("tiles", tiles);
    columns.integer("beams", beams);
    columns.integer("mixed", mixed);
    columns.integer("without_pose", without_pose);
    columns.integer("out_of_range", out_of_range);
    columns.integer("cells", cells);
  }
};

}  // namespace urban_nav_store
