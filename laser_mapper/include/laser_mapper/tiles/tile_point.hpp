// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "laser_mapper/map_cell.hpp"
#include "laser_mapper/map_point.hpp"

namespace laser_mapper {

/// Level 0 is the finest: its voxels have the edge Parameters::voxel, those of level k are 2^k times as large. The
/// voxels of the coarsest level fit into the tiles of the finest one (kTileCells = 2 * 2^7 voxels): levels are divided
/// tile by tile.
constexpr int kCoarsestLevel = 7;

/// Edge of a voxel of level 0 in steps, the unit of stored positions: 0.2 mm for voxels of 5 cm.
constexpr int kVoxelSteps = 256;

/// Bytes of a point in a tile before compression.
constexpr std::size_t kTilePointBytes = 20;

/// Point of the map as stored for display.
struct TilePoint {
  std::int32_t x = 0, y = 0, z = 0;  ///< steps from the origin of the map, rounded down
  std::uint16_t session = 0;         ///< index of the session in TileList::sessions
  std::uint32_t pose = 0;            ///< index of the pose of that session nearest in time, 24 bits
  std::uint8_t red = 0, green = 0, blue = 0, reflectance = 0;
  std::uint8_t sensor = 0;  ///< sensor id (sensors.hpp)
  std::uint8_t sigma = 0;   ///< 0.5 mm; 255: at least that
};
bool operator<(const TilePoint& a, const TilePoint& b);
bool operator==(const TilePoint& a, const TilePoint& b);

/// Returns a point of the map for display, without its session and pose. `voxel`: Parameters::voxel, m.
TilePoint toTilePoint(const MapPoint& point, double voxel);
/// Returns the position of a point in the map, m: the middle of its steps, at most half a step away along each axis.
Eigen::Vector3d tilePlace(const TilePoint& point, double voxel);
/// Returns the tile of the finest level that contains a point.
Tile finestTile(const TilePoint& point);

/// A tile of a level: a column of the map, kTileCells voxels of that level wide along x and y.
struct LevelTile {
  int level = 0;
  Tile tile;
};
inline bool operator==(const LevelTile& a, const LevelTile& b) { return a.level == b.level && a.tile == b.tile; }
/// Prints "level/x,y".
std::string toString(const LevelTile& tile);
/// Returns the inverse of toString(); nullopt for other text and for levels that do not exist.
std::optional<LevelTile> parseLevelTile(std::string_view text);

/// Returns the tile of a level that contains a tile of the finest level.
LevelTile coveringTile(const Tile& finest, int level);

/// Encodes the points of a tile, kTilePointBytes each, by column: x and y (steps from the tile's corner), z (steps plus
/// 2^23), pose, each in three bytes, session in two, then red, green, blue, reflectance, sensor, sigma; of numbers of
/// several bytes the lowest of all points first.
std::string printTile(const LevelTile& tile, const std::vector<TilePoint>& points);
/// Decodes the points; nullopt if the bytes are damaged.
std::optional<std::vector<TilePoint>> readTile(const LevelTile& tile, std::string_view bytes);

}  // namespace laser_mapper
