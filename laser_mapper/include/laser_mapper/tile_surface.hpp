// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "laser_mapper/map_point.hpp"
#include "laser_mapper/parameters.hpp"
#include "laser_mapper/tile_cells.hpp"

namespace laser_mapper {

/// Voxels around a tile that affect its surfaces.
constexpr int kTileMargin = 24;

/// Returns the standard deviation of a point along a direction in the map, m, due to the uncertainty of the pose from
/// which it was measured.
using PoseSigma = std::function<double(const MergedCell& cell, const Eigen::Vector3d& p, const Eigen::Vector3d& along)>;

/// Computes the points of a tile's voxels: normals from the neighbourhood, positions moved onto the surface as far as
/// noise explains the distance, uncertainties, reflectance. A voxel whose beams belong to the surface in the adjacent
/// voxel yields no point. `cells`: voxels of the tile; `margin`: those around it within kTileMargin. Points are in the
/// order of `cells`. Thread-safe if `pose_sigma` is.
std::vector<MapPoint> makeSurface(const Parameters& parameters, const Tile& tile, const std::vector<MergedCell>& cells,
                                  const std::vector<MergedCell>& margin, const PoseSigma& pose_sigma);

/// Computes points of dense stereo where no laser measured anything within 0.2 m: positions moved onto the plane of the
/// neighbourhood as far as noise explains the distance, with standard deviations; voxels without a plane yield no
/// point. `stereo`: voxels of the tile; `cells`, `margin`: those of the lasers, as in makeSurface(). Thread-safe if
/// `pose_sigma` is.
std::vector<MapPoint> makeStereoSurface(const Parameters& parameters, const Tile& tile,
                                        const std::vector<MergedCell>& stereo, const std::vector<MergedCell>& cells,
                                        const std::vector<MergedCell>& margin, const PoseSigma& pose_sigma);

}  // namespace laser_mapper
