// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "laser_mapper/map_point.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace laser_mapper {

/// Sizes of an OccupancyGrid, m.
struct GridModel {
  double resolution = 0.1;        ///< edge of a cell
  double margin = 30.0;           ///< around the path, covered by the grid
  double obstacle_height = 0.12;  ///< least height of obstacles above the ground around them, includes kerbs
  double robot_height = 1.5;      ///< points higher above the ground are not obstacles; beams at that height are not
                                  ///< evidence of free space
  double robot_radius = 0.35;     ///< around each pose, free because the robot was there
};

/// Returns the origin of the beams of a point; nullopt if it is unknown.
using BeamOrigin = std::function<std::optional<urban_nav_core::Vector3d>(const MapPoint& point)>;

/// Occupancy grid of the map for planners: cells with obstacles, cells that beams passed near the ground, and unknown
/// ones. The ground is grown from the path outwards, so that slopes are not obstacles. Order of calls: addSurface() for
/// all points, findGround() once, addBeams() for all points, then image(). The result does not depend on the order of
/// the points. Not thread-safe.
class OccupancyGrid {
 public:
  /// `path`: poses of base_link, which is on the ground.
  OccupancyGrid(const GridModel& model, const std::vector<urban_nav_core::Vector3d>& path);

  void addSurface(const std::vector<MapPoint>& points);
  void findGround();
  void addBeams(const std::vector<MapPoint>& points, const BeamOrigin& origin);

  /// Returns the cells of the image in the encoding of map_server: 0 obstacle, 254 free, 205 unknown; rows from the
  /// north.
  std::vector<std::uint8_t> image() const;
  int width() const { return width_; }
  int height() const { return height_; }
  /// Returns the coordinates of the south-western corner, m.
  double x0() const { return x0_; }
  double y0() const { return y0_; }

 private:
  struct Cell {
    float low = 1e9F;     ///< m, lowest point
    float ground = 1e9F;  ///< m; 1e9: not reached
    std::uint16_t obstacles = 0;
    bool passed = false, driven = false;
  };
  std::optional<std::size_t> index(double x, double y) const;
  float groundAround(std::size_t cell) const;
  void markDriven();
  void lowerPath();
  void followBeam(const urban_nav_core::Vector3d& from, const urban_nav_core::Vector3d& to);

  const GridModel model_;
  const std::vector<urban_nav_core::Vector3d> path_;
  double x0_ = 0.0, y0_ = 0.0;
  int width_ = 1, height_ = 1;
  std::vector<Cell> cells_;
};

/// Returns the binary PGM of an image with one byte per pixel.
std::string printPgm(const std::vector<std::uint8_t>& image, int width, int height);
/// Returns the YAML of map_server for a grid; `image`: name of the PGM.
std::string printGridYaml(const OccupancyGrid& grid, const GridModel& model, const std::string& image);

}  // namespace laser_mapper
