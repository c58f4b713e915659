// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "laser_mapper/tiles/tile_point.hpp"
#include "urban_nav_store/session.hpp"

namespace laser_mapper {

/// A tile of the list.
struct ListedTile {
  LevelTile tile;
  std::uint32_t points = 0;
  std::int32_t lowest = 0, highest = 0;  ///< z of its points, steps
  std::uint16_t session = 0;             ///< session and
  std::uint32_t pose = 0;                ///< pose of one of its points: the tile moves about as this pose does
};

/// All tiles of a map.
struct TileList {
  struct MappedPoses {
    urban_nav_store::SessionId session;
    std::uint32_t poses = 0;  ///< stored poses of the session, to which TilePoint::pose refers
  };
  double voxel = 0.0;  ///< edge of the voxels of level 0, m
  std::vector<MappedPoses> sessions;
  std::vector<ListedTile> tiles;  ///< coarse levels first, then in the order of Tile
  std::string digest;             ///< of the points of all tiles

  std::uint64_t points() const;
  /// Returns the width of a tile, m.
  double width(int level) const { return voxel * kTileCells * (1 << level); }
};

std::string packTileList(const TileList& list);
/// Decodes a list; nullopt if the bytes are damaged.
std::optional<TileList> unpackTileList(std::string_view bytes);

/// Returns the tiles that reach into an extent of the map, as long as all of them together have at most `budget`
/// points: levels as a whole, coarse ones first, and of the first level that exceeds the budget the tiles that are
/// nearest to the middle. `extent`: lowest x and y, highest x and y, m; nullopt: the whole map.
std::vector<ListedTile> selectTiles(const TileList& list, const std::optional<std::array<double, 4>>& extent,
                                    std::uint64_t budget);

}  // namespace laser_mapper
