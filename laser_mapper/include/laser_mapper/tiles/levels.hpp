// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "laser_mapper/tiles/tile_point.hpp"

namespace laser_mapper {

/// Points of a tile of the finest level, by level; each sorted, so that similar bytes are neighbours.
using Levels = std::array<std::vector<TilePoint>, kCoarsestLevel + 1>;

/// Divides the points of one tile of the finest level into levels of detail. A point belongs to the coarsest level at
/// which it is the first one in its voxel; those that are first nowhere belong to level 0. "First" is meant in a
/// pseudo-random order that depends on positions alone, so that coarse levels have no pattern. The levels from k up
/// have exactly one point in each occupied voxel of level k > 0. The result does not depend on the order of `points`.
/// Thread-safe.
Levels divideIntoLevels(std::vector<TilePoint> points);

}  // namespace laser_mapper
