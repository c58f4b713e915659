// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/json.hpp"
#include "laser_mapper/tiles/tile_list.hpp"

namespace urban_nav {

/// Part of the tiles of a map.
struct TileSelection {
  std::optional<std::array<double, 4>> extent;  ///< lowest x and y, highest x and y, m; nullopt: all of the map
  std::optional<std::uint64_t> budget;          ///< most points; nullopt: all
};

/// Returns the list of the tiles of a map for the scripts of the page: `digest`, `voxel` (m), `sessions` (their ids),
/// and `tiles`, coarse levels first, each as "level/x,y points lowest highest session pose": lowest and highest z in m;
/// session and pose, indices, are those of one of the points.
Json tilesAsJson(const laser_mapper::TileList& list, const TileSelection& selection);

}  // namespace urban_nav
