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

/// The cells of a chunk in a tile, as the store has them.
struct PackedPart {
  Tile tile;
  std::int64_t cells = 0;
  std::string data;
};
PackedPart packPart(const Tile& tile, const std::vector<MapCell>& cells);

/// Chunks of one session in a store.
class ChunkStore {
 public:
  ChunkStore(urban_nav_store::Store& store, const urban_nav_store::SessionId& session)
      : session_(session), chunks_(store), cells_(store) {}

  /// Returns all chunks by their beginnings.
  std::map<urban_nav_core::StampNs, urban_nav_store::MapChunk> chunks() const;
  /// Writes a chunk; `header` describes it. `old`: the stored chunk that it replaces, if any.
  void put(urban_nav_store::MapChunk header, std::vector<PackedPart> parts, const urban_nav_store::MapChunk* old);
  void remove(const urban_nav_store::MapChunk& chunk);
  /// Replaces the cells of a stored chunk in a tile by the same cells with other flags.
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

/// Poses along a chunk, to notice that it moved.
std::string packChunkPoses(const urban_nav_core::Trajectory& T_map_base, urban_nav_core::StampNs begin,
                           urban_nav_core::StampNs max_gap);
/// Returns by how much the points of a chunk, some 10 m away, have moved since its poses were packed, m; infinity if
/// the trajectory now covers other times, or the bytes are damaged.
double chunkShift(const std::string& packed, const urban_nav_core::Trajectory& T_map_base,
                  urban_nav_core::StampNs begin, urban_nav_core::StampNs max_gap);

/// Digest of all that a chunk depends on besides its poses and scans.
std::string renderSettings(const Parameters& parameters, const std::vector<MountedLaser>& lasers);

}  // namespace laser_mapper
