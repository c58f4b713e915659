// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "laser_mapper/layers/ground_grid.hpp"
#include "laser_mapper/map_point.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace laser_mapper {

/// Returns the origin of the beams of a point; nullopt if it is unknown.
using BeamOrigin = std::function<std::optional<urban_nav_core::Vector3d>(const MapPoint& point)>;

/// Occupancy grid of the map for planners: cells with obstacles, cells that beams passed near the ground, and unknown
/// ones. Obstacles are measured from the ground around them, so that slopes are free. Call addBeams() for all points,
/// then image(). The result does not depend on the order of the points. Not thread-safe.
class OccupancyGrid {
 public:
  /// `ground`: after find(); must outlive the grid.
  explicit OccupancyGrid(const GroundGrid& ground) : ground_(ground), cells_(ground.size()) {}

  void addBeams(const std::vector<MapPoint>& points, const BeamOrigin& origin);

  enum class State { Unknown, Free, Obstacle };
  /// Returns the state of a cell by its number in the GroundGrid.
  State state(std::size_t cell) const;
  /// Returns the cells of the image in the encoding of map_server: 0 obstacle, 254 free, 205 unknown; rows from the
  /// north.
  std::vector<std::uint8_t> image() const;

 private:
  struct Cell {
    std::uint16_t obstacles = 0;  ///< points
    bool passed = false;
  };
  void followBeam(const urban_nav_core::Vector3d& from, const urban_nav_core::Vector3d& to);

  const GroundGrid& ground_;
  std::vector<Cell> cells_;
};

/// Pose and cell edge of the image of a grid in the frame that its YAML is of.
struct GridPlacement {
  double resolution = 0.1;  ///< m
  double x = 0.0, y = 0.0;  ///< m, south-western corner
  double yaw = 0.0;         ///< rad, from the x axis of the frame to the columns of the image, anticlockwise
};

/// Returns the placement of a grid in the frame of its points.
GridPlacement localPlacement(const GroundGrid& ground);

/// Returns the binary PGM of an image with one byte per pixel.
std::string printPgm(const std::vector<std::uint8_t>& image, int width, int height);
/// Returns the YAML of map_server for a grid; `image`: name of the PGM.
std::string printGridYaml(const GridPlacement& placement, const std::string& image);

}  // namespace laser_mapper
