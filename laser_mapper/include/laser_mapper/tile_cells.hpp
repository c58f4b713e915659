// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "laser_mapper/map_cell.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace laser_mapper {

/// All beams of the map that ended in one voxel.
struct MergedCell {
  Cell cell;
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();    ///< mean, relative to the voxel's corner, in voxel edges
  Eigen::Vector3f to_laser = Eigen::Vector3f::Zero();  ///< mean direction towards the laser
  float count = 0.0F, range = 0.0F, intensity = 0.0F;  ///< beams; means, in m and raw values
  std::uint8_t laser = 0;                              ///< sensor in the pass below
  std::uint16_t pass = 0;                              ///< pass of most of the beams
  std::uint16_t session = 0;                           ///< session index of that pass
  urban_nav_core::StampNs stamp = 0;                   ///< mean over that pass
};

/// Origin of the cells of a chunk.
struct CellSource {
  std::uint16_t session = 0;
  std::uint16_t pass = 0;
  urban_nav_core::StampNs begin = 0;  ///< beginning of the chunk
};

/// Accumulates the chunks of one tile. The result depends on the order of calls. Not thread-safe.
class TileMerger {
 public:
  TileMerger() : table_(1 << 12) {}
  /// Origin of cells.
  enum class Kind { Lasers, Stereo };
  /// Adds the cells of one kind, except ghosts.
  void add(const CellSource& source, const std::vector<MapCell>& cells, Kind kind = Kind::Lasers);
  /// Returns the number of beams omitted as ghosts since the last take().
  std::size_t ghostBeams() const { return ghost_beams_; }
  /// Returns the voxels in order of first occurrence, and clears the tile.
  std::vector<MergedCell> take();

 private:
  /// Beams of the pass that a voxel is counting.
  struct PassVotes {
    std::uint16_t session = 0, pass = 0;
    std::uint8_t laser = 0;
    float count = 0.0F;
    double time = 0.0;  ///< sum, ms from the stamp `since`
    urban_nav_core::StampNs since = 0;
  };
  static void elect(MergedCell& cell, const PassVotes& votes);

  urban_nav_registration::CellTable table_;
  std::vector<MergedCell> cells_;
  std::vector<PassVotes> votes_;
  std::size_t ghost_beams_ = 0;
  std::vector<float> best_;     ///< beams of the pass stored in MergedCell
  std::vector<float> weights_;  ///< total weights of the means of MergedCell
};

}  // namespace laser_mapper
