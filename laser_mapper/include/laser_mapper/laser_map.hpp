// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "laser_mapper/chunk_renderer.hpp"
#include "laser_mapper/map_point.hpp"
#include "laser_mapper/parameters.hpp"
#include "laser_mapper/passes.hpp"
#include "laser_mapper/quality/plane_place.hpp"
#include "laser_mapper/tile_cells.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_store/store.hpp"

namespace laser_mapper {

class RelativeCovariances;

/// Removes the rendered chunks of a session from a store, so that the next map renders all of them.
void forgetChunks(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// Session of the map. The members pointed to must outlive the map.
struct MappedSession {
  urban_nav_store::SessionId id;
  const urban_nav_core::Trajectory* T_map_base = nullptr;
  /// Covariances of T_map_base, one per pose; poses without one, at the end, count as exact.
  const std::vector<urban_nav_core::Matrix6d>* covariances = nullptr;
};

/// Statistics of rendering.
struct RenderStatistics {
  std::size_t chunks = 0;
  std::size_t chunks_rendered = 0;    ///< the others were stored, with unchanged poses
  BeamCounts beams;                   ///< of all chunks
  std::vector<std::string> warnings;  ///< about the data
};

/// Map of the laser scans of sessions in one map frame (Newman et al. 2009, section 6.1). Scans are read from the
/// store, and rendered chunks are written to it; a chunk is rendered again only if its poses moved by at least
/// Parameters::max_shift. Points traversed by beams of other times are omitted (Parameters::ghosts). Memory depends on
/// the width of the map, not on its length or on the duration of the sessions. The output is bit-identical for any
/// number of threads. Not thread-safe.
class LaserMap {
 public:
  using ProgressCallback = std::function<void(std::size_t done, std::size_t all)>;
  using TileCallback = std::function<void(const Tile& tile, const std::vector<MapPoint>& points)>;
  using PassCallback = std::function<void(std::size_t index, const std::vector<PassCells>& passes)>;

  /// The store must outlive the map. Sessions without scans are ignored.
  LaserMap(const Parameters& parameters, urban_nav_store::Store& store, std::vector<MappedSession> sessions);

  /// Updates the chunks in the store and commits them. Throws the errors of the store.
  RenderStatistics render(const ProgressCallback& progress = {});

  /// Loads the chunks and uncertainties written by render(), without changing the store. Requires that chunks were
  /// rendered along T_map_base with the parameters of this map.
  void load();

  /// Calls `take` for the tiles that have points, in the order of Tile. Returns the number of beams omitted because
  /// beams of other times passed through their ends. Requires an earlier render() or load(). Throws DataError if the
  /// store is damaged.
  std::size_t forEachTile(const TileCallback& take) const;

  /// Calls `take` with the cells of each tile by pass, in the order of passes; `index`: of the tile in the order of
  /// Tile. Calls for different tiles are concurrent. Requires an earlier render() or load(). Throws DataError if the
  /// store is damaged.
  void forEachTileByPass(const PassCallback& take) const;

  const std::vector<SessionPasses>& passes() const { return passes_; }
  const Parameters& parameters() const { return parameters_; }
  /// Returns the number of tiles that have cells.
  std::size_t tileCount() const { return tiles_.size(); }

 private:
  using Tiles = std::set<Tile>;
  /// Packed cells of a chunk in a tile.
  struct PackedCells {
    CellSource source;
    std::string data;
  };
  std::vector<std::vector<PackedCells>> readRow(const std::vector<Tile>& tiles) const;
  struct MergedTile {
    std::vector<MergedCell> cells, stereo;
    std::size_t ghost_beams = 0;
  };
  std::vector<MergedTile> mergeRow(const std::vector<Tile>& tiles) const;
  MergedTile mergePacked(const Tile& tile, const std::vector<const PackedCells*>& packed) const;
  double poseSigma(const MergedCell& cell, const Eigen::Vector3d& p, const Eigen::Vector3d& along) const;

  const Parameters parameters_;
  urban_nav_store::Store& store_;
  const std::vector<MappedSession> sessions_;
  std::vector<SessionPasses> passes_;
  std::vector<std::shared_ptr<const RelativeCovariances>> covariances_;  ///< by session; null: exact poses
  Tiles tiles_;                                                          ///< tiles with cells in the store
};

/// Returns the parameters of the stored map of a session; nullopt if the store has none. Throws DataError if the store
/// is damaged.
std::optional<Parameters> storedMapParameters(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace laser_mapper
