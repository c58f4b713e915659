// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/tile_json.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

Json tilesAsJson(const laser_mapper::TileList& list, const TileSelection& selection) {
  const double step = list.voxel / laser_mapper::kVoxelSteps;
  Json json = Json::object({{"digest", list.digest}, {"voxel", list.voxel}});
  Json& sessions = json["sessions"] = Json::array();
  for (const laser_mapper::TileList::MappedPoses& each : list.sessions) sessions.append(each.session);
  Json& tiles = json["tiles"] = Json::array();
  const std::uint64_t budget = selection.budget.value_or(std::numeric_limits<std::uint64_t>::max());
  for (const laser_mapper::ListedTile& tile : laser_mapper::selectTiles(list, selection.extent, budget)) {
    std::string words = toString(tile.tile) + " " + std::to_string(tile.points);
    for (const double z : {std::floor(1e3 * step * tile.lowest), std::ceil(1e3 * step * tile.highest)})
      words += " " + urban_nav_core::printNumber(z / 1e3);
    tiles.append(words + " " + std::to_string(tile.session) + " " + std::to_string(tile.pose));
  }
  return json;
}

}  // namespace urban_nav
