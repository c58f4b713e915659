// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "laser_mapper/layers/raster.hpp"

namespace laser_mapper {

/// Robot that drives on the terrain. The defaults are those of a robot with wheels of 0.4 to 0.5 m.
struct TraversabilityModel {
  double radius = 0.35;           ///< m, of the area below the robot
  double slope_limit = 20.0;      ///< deg; the steepest street there is has 19 deg (Baldwin Street, Dunedin)
  double step_limit = 0.12;       ///< m, least height of an obstacle in the grid for planners
  double roughness_limit = 0.05;  ///< m, as traversability_estimation of Wermelinger et al.
};

/// Layers of a height model, each on its cells; kNoValue where the height model has none or too few cells around.
struct TerrainLayers {
  Raster slope;           ///< deg, of the plane through the heights within TraversabilityModel::radius
  Raster step;            ///< m, largest difference of adjacent cells within the radius
  Raster roughness;       ///< m, standard deviation of the heights from that plane
  Raster traversability;  ///< 0 (none) to 1 (flat and smooth)
};

/// Computes slope, step and roughness of a height model, and from them the traversability of Wermelinger et al. 2016
/// (Navigation planning for legged robots in challenging terrain, section III): one minus the mean of the three
/// relative to their limits; 0 if one of them reaches its limit. `scale`: length on the raster of a metre on the
/// ground, for rasters in projected coordinates. The result does not depend on the number of threads.
TerrainLayers terrainLayers(const Raster& elevation, const TraversabilityModel& model, double scale = 1.0);

}  // namespace laser_mapper
