// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "laser_mapper/map_point.hpp"
#include "laser_mapper/parameters.hpp"
#include "laser_mapper/tile_cells.hpp"

namespace laser_mapper {

/// Cubes around a tile that its surfaces depend on.
constexpr int kTileMargin = 24;

/// Returns the standard deviation of a point along a direction in the map, m, because of the pose it was measured from.
using PoseSigma = std::function<double(const MergedCell& cell, const Eigen::Vector3d& p, const Eigen::Vector3d& along)>;

/// Makes points of the cubes of a tile: normals of their neighbourhood, positions moved onto the surface as far as
/// noise explains their distance from it, uncertainties, reflectance. A cube whose beams belong to the surface in the
/// next one adds no point. `cells`: those of the tile; `margin`: those around it within kTileMargin. The points are in
/// the order of `cells`. Thread-safe if `pose_sigma` is.
std::vector<MapPoint> makeSurface(const Parameters& parameters, const Tile& tile, const std::vector<MergedCell>& cells,
                                  const std::vector<MergedCell>& margin, const PoseSigma& pose_sigma);

/// Makes points of dense stereo where no laser measured anything within 0.2 m: positions moved onto the plane of their
/// neighbourhood as far as noise explains, with their standard deviations; cubes without a plane add no point.
/// `stereo`: cubes of the tile; `cells`, `margin`: those of the lasers, as makeSurface() takes them. Thread-safe if
/// `pose_sigma` is.
std::vector<MapPoint> makeStereoSurface(const Parameters& parameters, const Tile& tile,
                                        const std::vector<MergedCell>& stereo, const std::vector<MergedCell>& cells,
                                        const std::vector<MergedCell>& margin, const PoseSigma& pose_sigma);

}  // namespace laser_mapper
