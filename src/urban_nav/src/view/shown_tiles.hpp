// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/scratch_folder.hpp"
#include "laser_mapper/tiles/tile_list.hpp"
#include "topics/lasers/tile_json.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// The tiles of the maps of a store, with the poses at which their points were rendered: points follow their poses
/// after a relaxation, without rendering. Thread-safe except for the store.
class ShownTiles {
 public:
  using Maps = std::vector<std::vector<urban_nav_store::StoredTrajectory>>;

  /// Reads the lists of the tiles in a store. If it lacks those of a map, because the store is older or several were
  /// merged, the tiles of all maps are computed as for `export` and kept in a temporary file. `memory_mb`: for decoded
  /// images. Throws the errors of the store.
  ShownTiles(urban_nav_store::Store& store, const Maps& maps, double memory_mb);

  /// Returns `sets`: tilesAsJson() of each map.
  Json list(const TileSelection& selection) const;

  /// Returns a tile of a set as zlib data of the bytes of laser_mapper::printTile(); nullopt without it. `store`:
  /// that of the constructor, opened for reading.
  std::optional<std::string> tile(urban_nav_store::Store& store, std::size_t set, const laser_mapper::LevelTile& tile);

  /// Returns the motion of poses since rendering, for each session of each set in their order: the number of poses, 0
  /// if none has moved (uint32), then of each pose the rotation (quaternion x, y, z, w), its position then, and its
  /// position in `maps` (m), as float32; little endian. `maps`: of the same store.
  std::string moves(const Maps& maps) const;

 private:
  struct Set {
    laser_mapper::TileList list;
    std::vector<std::vector<urban_nav_core::Pose>> rendered;  ///< by session and pose
  };
  bool readStored(urban_nav_store::Store& store, const Maps& maps);
  void compute(urban_nav_store::Store& store, const Maps& maps, double memory_mb);

  std::vector<Set> sets_;
  std::mutex mutex_;  ///< guards computed_
  std::unique_ptr<ScratchFolder> folder_;
  std::unique_ptr<urban_nav_store::Store> computed_;  ///< null: the tiles are in the store
};

}  // namespace urban_nav
