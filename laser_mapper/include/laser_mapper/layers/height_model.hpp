// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "laser_mapper/layers/ground_grid.hpp"
#include "laser_mapper/layers/raster.hpp"
#include "laser_mapper/map_point.hpp"

namespace laser_mapper {

/// Height of what a robot meets in each cell of a map: the ground, and objects on it up to GridModel::robot_height
/// above the ground; what is higher, such as crowns of trees, arches and lamps, is passed below. Heights are means of
/// the points, where these lie within GridModel::obstacle_height of the lowest one; otherwise that of the highest
/// point. Call add() for all points, then elevation(). The result does not depend on the order of points but for
/// rounding. Not thread-safe.
class HeightModel {
 public:
  /// `ground`: after find(); must outlive the model.
  explicit HeightModel(const GroundGrid& ground) : ground_(ground), cells_(ground.size()) {}

  void add(const std::vector<MapPoint>& points);

  /// Returns the heights, m; kNoValue in cells without points.
  Raster elevation() const;

 private:
  struct Cell {
    float sum = 0.0F;                   ///< m, heights of the near points above the lowest one
    std::uint16_t near = 0, above = 0;  ///< points near the lowest one in height, and higher ones
    float highest = 0.0F;               ///< m, height of the highest one of these
  };

  const GroundGrid& ground_;
  std::vector<Cell> cells_;
};

}  // namespace laser_mapper
