// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "laser_mapper/map_cell.hpp"
#include "urban_nav_core/laser/beam_renderer.hpp"

namespace laser_mapper {

/// Averages the measurements of a chunk by the voxel of the map's grid in which they end. Not thread-safe.
class ChunkGrid {
 public:
  /// `centre`: centre of the chunk, m. `begin`: beginning of the chunk.
  ChunkGrid(double voxel, const Eigen::Vector3d& centre, urban_nav_core::StampNs begin);

  /// Returns the pose of the map in the frame of added points, whose axes are those of the map.
  urban_nav_core::Pose framePose() const;

  /// Adds a point in framePose(). `sensor`: id in MapCell::laser; `weight`: of the point in the means of the voxel;
  /// `count`: number of beams that it represents. Returns false for a point beyond the grid.
  bool add(const urban_nav_core::LaserPoint& point, std::uint8_t sensor, float weight = 1.0F, int count = 1);

  /// Marks the voxels of a kind of sensor for which `is_ghost` holds; eight voxels are tested at once, by their mean
  /// position in framePose().
  void markGhosts(const std::function<bool(std::uint8_t sensor)>& of_sensor,
                  const std::function<bool(const Eigen::Vector3d& p)>& is_ghost);

  /// Appends the voxels to those of their tiles, in the order of z, y, x.
  void appendTo(std::map<Tile, std::vector<MapCell>>& parts) const;

 private:
  /// Weighted sums over the measurements in a voxel.
  struct Sums {
    Cell cell;
    Eigen::Vector3f offset = Eigen::Vector3f::Zero(), to_laser = Eigen::Vector3f::Zero();
    float range = 0.0F, intensity = 0.0F, weight = 0.0F;
    urban_nav_core::StampNs time = 0;
    int points = 0, count = 0, sensor_votes = 0;
    std::uint8_t sensor = 0;
    bool is_ghost = false;
  };
  static MapCell mean(const Sums& sums);

  const float per_m_;
  const urban_nav_core::StampNs begin_;
  Cell origin_cell_;
  Eigen::Vector3d origin_;
  urban_nav_registration::CellTable table_;
  std::vector<Sums> sums_;  ///< in order of first occurrence
};

}  // namespace laser_mapper
