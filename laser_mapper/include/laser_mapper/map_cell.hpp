// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_registration/cloud/cell_table.hpp"

namespace laser_mapper {

using urban_nav_registration::Cell;

/// Values of MapCell::laser for depth cameras, and for dense stereo.
constexpr std::uint8_t kFirstDepthCamera = 123, kStereo = 127;
constexpr std::size_t kMostDepthCameras = kStereo - kFirstDepthCamera;
/// Returns whether a cell holds points on which several depth images agree.
inline bool isOfImages(std::uint8_t sensor) { return sensor >= kFirstDepthCamera; }

/// Voxels of a tile along x and y: a tile is a column of the map.
constexpr int kTileCells = 256;
/// Largest magnitude of a voxel's height index in a tile.
constexpr int kMaxHeightCell = 32767;

/// Beams of one chunk that ended in one voxel of the map's grid; or points of depth images (isOfImages()), whose grey
/// level is `intensity` and whose standard deviation along the line of sight is `range`. Values have the resolution of
/// the store.
struct MapCell {
  Cell cell;                                           ///< in the map's grid
  std::uint16_t count = 0;                             ///< beams
  std::uint8_t laser = 0;                              ///< sensor of most of the beams, 0...127
  bool is_ghost = false;                               ///< beams of other times passed through
  std::uint8_t intensity = 0;                          ///< mean of the raw values
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();    ///< mean of the ends, relative to the voxel's corner, in voxel
                                                       ///< edges, 0...1
  Eigen::Vector3f to_laser = Eigen::Vector3f::Zero();  ///< mean direction towards the laser
  float range = 0.0F;                                  ///< mean, m
  std::int32_t time_us = 0;                            ///< mean stamp relative to the chunk's beginning, us
};

/// Column of the map.
struct Tile {
  int x = 0, y = 0;
};
inline bool operator==(const Tile& a, const Tile& b) { return a.x == b.x && a.y == b.y; }
/// Order in files: rows along x.
inline bool operator<(const Tile& a, const Tile& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

/// Returns the tile of a voxel.
Tile tileAt(const Cell& cell);
/// Prints "x,y".
std::string toString(const Tile& tile);
/// Returns the inverse of toString(); nullopt for other text.
std::optional<Tile> parseTile(std::string_view text);

/// Encodes the voxels of one tile as compressed bytes, by column. Values are rounded to the resolution of the store.
std::string packCells(const Tile& tile, const std::vector<MapCell>& cells);
/// Decodes the cells; nullopt if the bytes are damaged.
std::optional<std::vector<MapCell>> unpackCells(const Tile& tile, std::string_view bytes);

}  // namespace laser_mapper
