// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "laser_mapper/chunk_renderer.hpp"
#include "mounted_laser.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/map_chunk.hpp"
#include "urban_nav_store/tables/map_chunk_cells.hpp"

namespace laser_mapper {

/// Packed cells of a chunk in a tile.
struct PackedPart {
  Tile tile;
  std::int64_t cells = 0;
  std::string data;
};
PackedPart packPart(const Tile& tile, const std::vector<MapCell>& cells);

/// Stored chunks of one session.
class ChunkStore {
 public:
  ChunkStore(urban_nav_store::Store& store, const urban_nav_store::SessionId& session)
      : session_(session), chunks_(store), cells_(store) {}

  /// Returns all chunks by beginning.
  std::map<urban_nav_core::StampNs, urban_nav_store::MapChunk> chunks() const;
  /// Writes a chunk; `header` describes it. `old`: the stored chunk that it replaces, if any.
  void put(urban_nav_store::MapChunk header, std::vector<PackedPart> parts, const urban_nav_store::MapChunk* old);
  void remove(const urban_nav_store::MapChunk& chunk);
  /// Replaces the cells of a stored chunk in a tile by cells with other flags.
  void putCells(urban_nav_core::StampNs begin, PackedPart part);
  /// Calls `take` for the chunks with cells in a tile, in order of time.
  void forEachInTile(const Tile& tile,
                     const std::function<void(urban_nav_core::StampNs begin, std::string data)>& take) const;

 private:
  urban_nav_store::SessionId session_;
  urban_nav_store::TableStore<urban_nav_store::MapChunk> chunks_;
  urban_nav_store::TableStore<urban_nav_store::MapChunkCells> cells_;
};

/// Returns the tiles of MapChunk::tiles.
std::vector<Tile> chunkTiles(const urban_nav_store::MapChunk& chunk);

/// Encodes the poses along a chunk, to detect that it moved.
std::string packChunkPoses(const urban_nav_core::Trajectory& T_map_base, urban_nav_core::StampNs begin,
                           urban_nav_core::StampNs max_gap);
/// Returns the displacement of a chunk's points, about 10 m away, since its poses were packed, m; infinity if the
/// trajectory now covers other times, or the bytes are damaged.
double chunkShift(const std::string& packed, const urban_nav_core::Trajectory& T_map_base,
                  urban_nav_core::StampNs begin, urban_nav_core::StampNs max_gap);

/// Returns a digest of everything that a chunk depends on besides its poses and scans.
std::string renderSettings(const Parameters& parameters, const std::vector<MountedLaser>& lasers);

}  // namespace laser_mapper
