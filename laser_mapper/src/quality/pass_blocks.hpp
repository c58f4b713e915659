// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "laser_mapper/quality/plane_place.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace laser_mapper {

/// Cell with its position.
struct PlacedCell {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< m, in the map
  const MergedCell* cell = nullptr;
};

/// Cells of one pass in a tile by blocks of 16 voxels along each axis. The cells must outlive it. Immutable, hence
/// thread-safe.
class PassBlocks {
 public:
  struct Block {
    std::uint64_t key = 0;
    std::vector<PlacedCell> cells;
  };
  PassBlocks(double voxel, const PassCells& pass);

  std::uint16_t pass() const { return pass_; }
  /// Returns the blocks in the order of their first cells.
  const std::vector<Block>& blocks() const { return blocks_; }
  /// Returns the cells of this tile within `radius` of the axis through `centre` along `normal`, and within `reach` of
  /// `centre` along it.
  std::vector<PlacedCell> around(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double radius,
                                 double reach) const;

 private:
  std::uint64_t blockKey(const Eigen::Vector3d& p) const;

  const double edge_;  ///< of the blocks, m
  const std::uint16_t pass_;
  urban_nav_registration::CellTable table_{1 << 8};
  std::vector<Block> blocks_;
};

}  // namespace laser_mapper
