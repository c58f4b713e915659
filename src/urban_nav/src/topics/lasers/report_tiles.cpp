// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/report_tiles.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "base/page.hpp"
#include "laser_mapper/tiles/tile_store.hpp"
#include "topics/lasers/tile_json.hpp"
#include "urban_nav_core/io/atomic_file.hpp"

namespace urban_nav {

namespace fs = std::filesystem;

namespace {

/// Returns the beginning of the names of the tiles of a view; they end in ".js".
std::string filePrefix(std::size_t number) { return std::to_string(number) + "_"; }

std::string tileFile(std::size_t number, const laser_mapper::LevelTile& tile) {
  return filePrefix(number) + std::to_string(tile.level) + "_" + std::to_string(tile.tile.x) + "_" +
         std::to_string(tile.tile.y) + ".js";
}

}  // namespace

void removeReportTiles(const std::string& folder, std::size_t number) {
  std::error_code ignored;
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(filePrefix(number), 0) == 0 && entry.path().extension() == ".js") old.push_back(entry.path());
  }
  for (const fs::path& path : old) fs::remove(path, ignored);
  fs::remove(folder, ignored);  // if it is empty
}

std::string writeReportTiles(urban_nav_store::Store& store, const urban_nav_store::SessionId& first,
                             const std::string& folder, std::size_t number) {
  removeReportTiles(folder, number);
  const std::optional<laser_mapper::TileList> list = laser_mapper::storedTileList(store, first);
  if (!list) return "";
  fs::create_directories(folder);
  for (const laser_mapper::ListedTile& listed : list->tiles) {
    const std::string bytes = laser_mapper::storedTile(store, first, listed.tile).value_or("");
    const std::string script = "urbanNav.takeTile(\"" + std::to_string(number) + "/" + toString(listed.tile) + "\",\"" +
                               base64({bytes.begin(), bytes.end()}) + "\");\n";
    urban_nav_core::writeAtomically((fs::path(folder) / tileFile(number, listed.tile)).string(), script);
  }
  return tilesAsJson(*list, {}).print();
}

}  // namespace urban_nav
