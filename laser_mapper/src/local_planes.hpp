// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "laser_mapper/tile_cells.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace laser_mapper {

/// Best-fitting plane of a neighbourhood.
struct LocalPlane {
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  ///< m, in the frame of LocalPlanes
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float thickness = 0.0F;  ///< m, standard deviation of the voxel means about the plane
  float weight = 0.0F;     ///< number of beams used
  int level = 0;           ///< width of the neighbourhood: 3 * 2^level voxels
};

/// Planes through the neighbourhoods of the voxels of a tile, from the moments of cubes of one, two, four and eight
/// voxel edges, because beams are sparse far from the laser. Caches computed planes. Not thread-safe. Positions are in
/// a frame with the axes of the map and its origin at the corner of the tile.
class LocalPlanes {
 public:
  LocalPlanes(double voxel, const Tile& tile, const std::vector<MergedCell>& cells,
              const std::vector<MergedCell>& margin);

  /// Returns the plane of the smallest neighbourhood that extends in two directions; nullopt if there is none.
  std::optional<LocalPlane> around(const MergedCell& cell);
  /// Returns whether another voxel represents the surface at a point of this one: it contains the point, or is the next
  /// one along the normal within `reach` (m) of noise; and it has more beams. `position`: of the point.
  bool belongsToAnother(const MergedCell& cell, const Eigen::Vector3f& position, const LocalPlane& plane,
                        float reach) const;
  Eigen::Vector3f position(const MergedCell& cell) const;
  Eigen::Vector3d inMap(const Eigen::Vector3f& position) const { return origin_ + position.cast<double>(); }

 private:
  static constexpr int kLevels = 4;
  /// Weighted sums over the voxels, w: number of beams of a voxel, at most kMaxWeight.
  struct Moments {
    float w = 0.0F;
    Eigen::Vector3f first = Eigen::Vector3f::Zero();                         ///< w times position
    Eigen::Matrix<float, 6, 1> second = Eigen::Matrix<float, 6, 1>::Zero();  ///< xx xy xz yy yz zz
    void add(const Moments& other, const Eigen::Vector3f& shift);
  };
  struct Level {
    urban_nav_registration::CellTable table{1 << 10};
    std::vector<Moments> cubes;  ///< relative to the centres of the cubes
    float edge = 0.0F;           ///< m
    /// Plane of the neighbourhood of each cube: index in `planes`, kUnknown, or kNone.
    std::vector<std::int32_t> plane_of;
    std::vector<LocalPlane> planes;
  };
  static constexpr std::int32_t kUnknown = -2, kNone = -1;
  bool hasMoreBeams(const Cell& other, const MergedCell& cell) const;
  Cell local(const Cell& cell) const { return {cell.x - corner_.x, cell.y - corner_.y, cell.z}; }
  void addToLevels(const MergedCell& cell);
  std::optional<LocalPlane> fitPlane(int level, const Cell& cube) const;
  std::optional<LocalPlane> planeAt(int level, const Cell& cell);

  const float voxel_;
  Cell corner_;
  Eigen::Vector3d origin_;
  std::vector<float> counts_;  ///< beams of each voxel of level 0
  std::array<Level, kLevels> levels_;
};

}  // namespace laser_mapper
