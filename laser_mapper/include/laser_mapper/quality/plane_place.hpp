// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "laser_mapper/tile_cells.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace laser_mapper {

/// Cells of one tile measured in one pass.
struct PassCells {
  std::uint16_t pass = 0;
  std::vector<MergedCell> cells;
};

/// Plane measured in one pass.
struct PlanePatch {
  std::uint16_t pass = 0;
  std::uint16_t session = 0;                           ///< session index of the pass
  std::size_t cells = 0;                               ///< number of cells used
  std::uint8_t laser = 0;                              ///< sensor of most of them
  double facing = 1.0;                                 ///< mean cosine of the angle between the normal and the beams
  urban_nav_core::StampNs stamp = 0;                   ///< mean
  double stamp_spread = 0.0;                           ///< s, standard deviation of the stamps
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< m, in the map: mean of the cells
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< unit, towards the laser
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();   ///< m^2, mean about the centre
  Eigen::Vector3d sweep = Eigen::Vector3d::Zero();     ///< m s, covariance of the cells and their stamps
  double thickness = 0.0;                              ///< m, standard deviation of the cells about the plane
  double angle_sigma = 0.0, displacement_sigma = 0.0;  ///< rad; m, along the normal
};

/// Place where several passes measured one plane, with their agreement (Newman et al. 2009, section 6.3).
struct PlanePlace {
  /// Two passes, at least 20 s apart.
  struct Pair {
    std::size_t a = 0, b = 0;                ///< indices into patches
    double angle = 0.0, displacement = 0.0;  ///< rad, between the normals; m, between the planes along their normal
  };
  std::vector<PlanePatch> patches;  ///< one per pass
  std::vector<Pair> pairs;          ///< at least one
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double angle = 0.0, displacement = 0.0;              ///< means over the pairs: rad; m
  double angle_sigma = 0.0, displacement_sigma = 0.0;  ///< standard deviations of these means due to noise only

  bool isWall() const;
  bool isGround() const;
};

/// Radius of a place in voxels of the map.
constexpr double kPlaceRadius = 12.0;
/// Edge, in voxels of the map, of the blocks of which each has at most one place.
constexpr int kPlaceSpacing = 16;

/// Returns the places of a tile whose cells are given by pass. The first pass that measured a planar surface in a block
/// of 16 voxels defines a place; other passes contribute the plane of most of their cells around its centre, if it
/// faces the same side. `voxel`: edge of the voxels, m; `range_bias`: standard deviation of a laser's constant error,
/// m. Thread-safe.
std::vector<PlanePlace> findPlanePlaces(double voxel, double range_bias, const std::vector<PassCells>& passes);

}  // namespace laser_mapper
