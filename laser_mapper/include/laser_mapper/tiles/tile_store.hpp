// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/tiles/levels.hpp"
#include "laser_mapper/tiles/tile_list.hpp"
#include "urban_nav_store/store.hpp"

namespace laser_mapper {

/// A session of the tiles.
struct TiledSession {
  urban_nav_store::SessionId id;
  std::optional<std::uint16_t> first_pass;      ///< nullopt: it has no points
  std::vector<urban_nav_core::StampNs> stamps;  ///< of its stored poses
};

/// Returns the sessions of a map, with the stamps of their poses in a store. `passes`: LaserMap::passes().
std::vector<TiledSession> tiledSessions(urban_nav_store::Store& store, const std::vector<MappedSession>& sessions,
                                        const std::vector<SessionPasses>& passes);

/// Writes the points of a map to a store as tiles of all levels of detail, in place of those that the store has of
/// these sessions. Memory depends on the width of the map, not on its length. The same points give the same bytes for
/// any number of threads. Not thread-safe.
class TileWriter {
 public:
  /// The store must outlive the writer. Removes the list of tiles: until
  /// finish() the store has none.
  TileWriter(urban_nav_store::Store& store, std::vector<TiledSession> sessions, double voxel);

  /// Adds the points of a tile. To be called in the order of Tile; points may lie in the tiles around it.
  void add(const Tile& tile, const std::vector<MapPoint>& points);
  /// Writes the tiles in memory and the list, and commits.
  void finish();

 private:
  using Pending = std::map<Tile, std::vector<TilePoint>>;
  TilePoint toStored(const MapPoint& point) const;
  void closeRowsBelow(int y);
  void write(const std::vector<std::pair<LevelTile, std::vector<TilePoint>>>& tiles);

  urban_nav_store::Store& store_;
  const std::vector<TiledSession> sessions_;
  std::vector<std::pair<std::uint16_t, std::uint16_t>> by_pass_;  ///< first passes with their sessions
  TileList list_;
  Pending points_;                                   ///< of tiles of level 0 whose neighbours are not all added
  std::array<Pending, kCoarsestLevel + 1> pending_;  ///< by level, of tiles that are not written
  std::optional<int> row_;                           ///< last row of add()
  std::size_t uncommitted_ = 0;                      ///< bytes
};

/// Removes the tiles of a session.
void forgetTiles(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// Returns the list of the tiles of the map whose first session is `first`; nullopt if the store has none. Throws
/// DataError if the store is damaged.
std::optional<TileList> storedTileList(urban_nav_store::Store& store, const urban_nav_store::SessionId& first);
/// Returns a tile as zlib data (RFC 1950) of the bytes of printTile(); nullopt if the store has no such tile.
std::optional<std::string> storedTile(urban_nav_store::Store& store, const urban_nav_store::SessionId& first,
                                      const LevelTile& tile);
/// Returns the points of a tile; none if the store has no such tile. Throws DataError if the store is damaged.
std::vector<TilePoint> storedTilePoints(urban_nav_store::Store& store, const urban_nav_store::SessionId& first,
                                        const LevelTile& tile);

}  // namespace laser_mapper
