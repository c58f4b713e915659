// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "laser_mapper/map_cell.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace laser_mapper {

/// All beams of the map that ended in one cube.
struct MergedCell {
  Cell cell;
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();    ///< mean, from the cube's corner, in edges
  Eigen::Vector3f to_laser = Eigen::Vector3f::Zero();  ///< mean direction towards the laser
  float count = 0.0F, range = 0.0F, intensity = 0.0F;  ///< beams; means, m and raw value
  std::uint8_t laser = 0;                              ///< of the pass below
  std::uint16_t pass = 0;                              ///< that most of the beams came from
  std::uint16_t session = 0;                           ///< index, of that pass
  urban_nav_core::StampNs stamp = 0;                   ///< mean over that pass
};

/// Where cells of a chunk come from.
struct CellSource {
  std::uint16_t session = 0;
  std::uint16_t pass = 0;
  urban_nav_core::StampNs begin = 0;  ///< of the chunk
};

/// Adds up the chunks of one tile. The order of calls is part of the result. Not thread-safe.
class TileMerger {
 public:
  TileMerger() : table_(1 << 12) {}
  /// What cells come from.
  enum class Kind { Lasers, Stereo };
  /// Adds the cells of one kind; leaves ghosts out.
  void add(const CellSource& source, const std::vector<MapCell>& cells, Kind kind = Kind::Lasers);
  /// Returns the number of beams left out since the last take().
  std::size_t ghostBeams() const { return ghost_beams_; }
  /// Returns the cubes in the order in which they came, and becomes empty.
  std::vector<MergedCell> take();

 private:
  /// Beams of the pass that a cube counts at present.
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
  std::vector<float> best_;     ///< beams of the pass that MergedCell names
  std::vector<float> weights_;  ///< of all beams in the means of MergedCell
};

}  // namespace laser_mapper
