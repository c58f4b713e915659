// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "chunk_store.hpp"
#include "ghosts/chunk_beams.hpp"
#include "laser_mapper/laser_map.hpp"

namespace laser_mapper {

/// Flags the cells of a map that beams of other times passed through, left by moving objects (Pomerleau et al. 2014).
/// Processes the tiles affected by chunks rendered since the last call, and stores which chunks were processed. Not
/// thread-safe.
class GhostFinder {
 public:
  /// The arguments must outlive this object.
  GhostFinder(const Parameters& parameters, urban_nav_store::Store& store, const std::vector<MappedSession>& sessions);

  /// Updates the flags in the store; the caller commits. Throws DataError if the store is damaged.
  void update();

 private:
  struct Chunk {
    std::size_t session = 0;
    urban_nav_core::StampNs begin = 0;
    std::int64_t revision = 0;
    std::vector<Tile> tiles;     ///< tiles with its cells
    Tile reach_low, reach_high;  ///< tiles that its beams may have crossed
    bool changed = true;
  };
  /// Cells of one chunk in a tile.
  struct Row {
    std::size_t chunk = 0;
    std::string packed;
    std::vector<MapCell> cells;
    bool changed = false;
  };
  /// Cell observed at one time only.
  struct Candidate {
    std::size_t row = 0, cell = 0;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    int through = 0, hits = 0;  ///< numbers of chunks
  };
  /// Tile whose flags may change.
  struct TileTask {
    Tile tile;
    std::vector<std::size_t> holders, reaching;  ///< chunks with cells in it, and chunks with beams that may cross it
    std::vector<Row> rows;
    std::vector<Candidate> candidates;
  };

  void listChunks();
  void markChanged();
  void storeState();
  void updateTiles(std::vector<TileTask>& tasks);
  void readRows(TileTask& task) const;
  void unpackRows(TileTask& task) const;
  std::vector<Candidate> findCandidates(const std::vector<Row>& rows) const;
  void lookAtCandidates(TileTask& task);
  /// Sets the flags, and packs the rows whose flags have changed.
  static void flagGhosts(TileTask& task);
  /// Counts, for each candidate, the chunks whose beams pass through or hit it.
  void lookAtAll(const std::vector<Row>& rows, const std::vector<std::size_t>& chunks,
                 std::vector<Candidate>& candidates);
  std::vector<std::shared_ptr<const ChunkBeams>> shareBeams(const std::vector<std::size_t>& chunks);
  bool isApart(std::size_t a, std::size_t b) const;

  const Parameters& parameters_;
  urban_nav_store::Store& store_;
  const std::vector<MappedSession>& sessions_;
  std::vector<Chunk> chunks_;
  std::list<std::size_t> recent_;  ///< chunks in cache_, most recently used first
  std::map<std::size_t, std::shared_ptr<const ChunkBeams>> cache_;
};

}  // namespace laser_mapper
