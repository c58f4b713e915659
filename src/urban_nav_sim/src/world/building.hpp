// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "world/site.hpp"
#include "world/terrain.hpp"

namespace urban_nav_sim {

/// An opening in a wall: position (m along the wall and above z = 0), depth of the reveal, filling.
struct Opening {
  double u0, u1, v0, v1, depth = 0.18;
  Finish filling;
};

/// Builds a wall from `start` along a direction, from z = `low` to `high`, visible from its right; with reveals, sills
/// and fillings.
void buildWall(Site& site, const Finish& finish, const Finish& trim, const Eigen::Vector2d& start,
               const Eigen::Vector2d& along, double length, double low, double high,
               const std::vector<Opening>& openings);

/// Appearance of a building. Sides are in the order south, east, north, west.
struct Style {
  Finish wall, trim{MaterialKind::Kerb, 1, 0}, roof{MaterialKind::Slate, 0, 0}, door{MaterialKind::Door, 0, 0};
  MaterialKind window = MaterialKind::Sash;
  int storeys = 2;
  double storey = 3.4, window_width = 1.1, window_height = 1.7, sill = 0.95, spacing = 2.9;  ///< m
  double pitch = 0.7;  ///< of the roof, rise over run; 0: flat with a parapet
  bool battlements = false;
  std::array<int, 4> doors = {0, 0, 0, 0};  ///< 1-based bay of a side with a door; 0: none
  std::array<bool, 4> windows = {true, true, true, true};
  double irregular = 0.12;  ///< share of blank bays
  std::uint64_t seed = 0;
};

/// Builds a building with roof on a rectangle. Its floor, z = 0, is at the ground height of its centre.
void buildHouse(Site& site, const Extent& extent, const Style& style);

}  // namespace urban_nav_sim
