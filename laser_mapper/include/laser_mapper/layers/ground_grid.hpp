// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "laser_mapper/map_point.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace laser_mapper {

/// Sizes of the grids of a map, m.
struct GridModel {
  double resolution = 0.1;        ///< edge of a cell
  double margin = 30.0;           ///< around the path, covered by the grid
  double obstacle_height = 0.12;  ///< least height of obstacles above the ground around them, includes kerbs
  double robot_height = 1.5;      ///< points higher above the ground are not obstacles; beams at that height are not
                                  ///< evidence of free space
  double robot_radius = 0.35;     ///< around each pose, free because the robot was there
};

/// Height of the ground below every cell of a grid around the path. The ground is grown from the path outwards, so that
/// slopes and kerbs are ground, and cars, hedges and walls are not. Order of calls: addSurface() for all points, find()
/// once, then the others. The result does not depend on the order of the points. Not thread-safe.
class GroundGrid {
 public:
  /// `path`: poses of base_link, which is on the ground, in the frame of the points.
  GroundGrid(const GridModel& model, const std::vector<urban_nav_core::Vector3d>& path);

  void addSurface(const std::vector<MapPoint>& points);
  void find();

  const GridModel& model() const { return model_; }
  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return cells_.size(); }
  /// Returns the coordinates of the south-western corner, m.
  double x0() const { return x0_; }
  double y0() const { return y0_; }

  /// Returns the number of the cell at a position, rows from the south; nullopt outside the grid.
  std::optional<std::size_t> index(double x, double y) const;
  /// Returns the height of the ground of a cell, m; below walls, overhangs and where nothing was measured that of the
  /// nearest ground towards the path.
  float ground(std::size_t cell) const { return cells_[cell].ground; }
  /// Returns the third lowest ground within two cells, m: the base of obstacles, which erroneous points below the
  /// ground do not lower.
  float groundAround(std::size_t cell) const;
  /// Returns the height of the lowest point of a cell, m; nullopt without points.
  std::optional<float> lowest(std::size_t cell) const;
  /// Returns whether the robot was in the cell.
  bool isDriven(std::size_t cell) const { return cells_[cell].driven; }
  /// Returns whether a point is on the ground: within one cell edge of its height, thus also on slopes of up to 45 deg,
  /// and not on a steeper surface. False outside the grid.
  bool isGround(const MapPoint& point) const;

 private:
  struct Cell {
    float low = 1e9F;     ///< m, lowest point
    float ground = 1e9F;  ///< m; 1e9: not reached
    bool driven = false;
  };
  void markDriven();
  void lowerPath();

  const GridModel model_;
  const std::vector<urban_nav_core::Vector3d> path_;
  double x0_ = 0.0, y0_ = 0.0;
  int width_ = 1, height_ = 1;
  std::vector<Cell> cells_;
};

}  // namespace laser_mapper
