// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "laser_mapper/layers/raster.hpp"
#include "laser_mapper/layers/terrain.hpp"
#include "laser_mapper/map_point.hpp"
#include "laser_mapper/occupancy_grid.hpp"
#include "urban_nav_core/io/cloud/pcd_writer.hpp"

namespace laser_mapper {

/// Layers of the map for planners, on the same cells, whose rows begin in the south.
struct LiveLayers {
  Raster elevation;                        ///< m
  TerrainLayers terrain;                   ///< derived from the elevation
  std::vector<std::int8_t> occupancy;      ///< as in nav_msgs/OccupancyGrid: 0 free, 100 obstacle, -1 unknown
  std::vector<std::int8_t> traverse_cost;  ///< 0 flat and smooth ... 100 not traversable, -1 unknown
};

/// Calls a function with the points of each part of the map.
using ForEachPart = std::function<void(const std::function<void(const std::vector<MapPoint>&)>&)>;

/// Computes the layers. `path`: poses of base_link in the frame of the points; not empty.
LiveLayers makeLiveLayers(const ForEachPart& parts, const std::vector<urban_nav_core::Vector3d>& path,
                          const BeamOrigin& origin);

/// Return the cells with a height as points in the binary form of PCD files: x, y, z of the centre (m), slope (deg),
/// step, roughness (m) and traversability (0...1), NaN where a layer is unknown.
std::vector<urban_nav_core::PcdField> terrainFields();
std::string terrainPoints(const LiveLayers& layers);

}  // namespace laser_mapper
