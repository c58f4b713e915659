// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_registration/cloud/cell_table.hpp"

namespace laser_mapper {

using urban_nav_registration::Cell;

/// Number of dense stereo in MapCell::laser.
constexpr std::uint8_t kStereo = 127;

/// Cubes of a tile along x and y: a tile is a column of the map.
constexpr int kTileCells = 256;
/// Cubes higher or lower than this have no place in a tile.
constexpr int kMaxHeightCell = 32767;

/// Beams of one chunk that ended in one cube of the map's grid; or points of dense stereo there (laser kStereo), whose
/// grey is `intensity`, and whose standard deviation along the line of sight is `range`. Values are rounded as the
/// store holds them.
struct MapCell {
  Cell cell;                                           ///< in the map's grid
  std::uint16_t count = 0;                             ///< beams
  std::uint8_t laser = 0;                              ///< that most of the beams came from, 0...127
  bool is_ghost = false;                               ///< beams of other times passed through
  std::uint8_t intensity = 0;                          ///< mean of the raw values
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();    ///< mean of the ends, from the cube's corner, in edges, 0...1
  Eigen::Vector3f to_laser = Eigen::Vector3f::Zero();  ///< mean direction towards the laser
  float range = 0.0F;                                  ///< mean, m
  std::int32_t time_us = 0;                            ///< mean of the stamps, from the chunk's beginning, us
};

/// A column of the map.
struct Tile {
  int x = 0, y = 0;
};
inline bool operator==(const Tile& a, const Tile& b) { return a.x == b.x && a.y == b.y; }
/// Order of the files: rows along x.
inline bool operator<(const Tile& a, const Tile& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

/// Returns the tile of a cube.
Tile tileAt(const Cell& cell);
/// "x,y".
std::string toString(const Tile& tile);
/// Returns the inverse of toString(); nullopt for other text.
std::optional<Tile> parseTile(std::string_view text);

/// Returns the cubes of one tile as compressed bytes, column by column. Rounds the cells as unpackCells() returns them.
std::string packCells(const Tile& tile, const std::vector<MapCell>& cells);
/// Returns the cells; nullopt if the bytes are damaged.
std::optional<std::vector<MapCell>> unpackCells(const Tile& tile, std::string_view bytes);

}  // namespace laser_mapper
