// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "laser_mapper/map_cell.hpp"
#include "laser_mapper/parameters.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper {

/// Duration of a chunk. Chunks begin at multiples of it, hence a recording has the same chunks in every run.
constexpr urban_nav_core::StampNs kChunkNs = 4'000'000'000;

/// Returns the beginning of the chunk that a stamp falls into.
urban_nav_core::StampNs chunkBegin(urban_nav_core::StampNs stamp);

/// Scans of one laser.
struct LaserInput {
  urban_nav_core::Pose T_base_laser;
  int laser = 0;  ///< 0 left, 1 right
  std::vector<urban_nav_core::Scan> scans;
};

/// Points of dense stereo of one pair of images.
struct StereoFrame {
  struct Point {
    Eigen::Vector3f p_base = Eigen::Vector3f::Zero();  ///< m
    float sigma = 0.0F;                                ///< m, along the line of sight
    float grey = 0.0F;                                 ///< 0...255
  };
  urban_nav_core::StampNs stamp = 0;
  Eigen::Vector3d camera_base = Eigen::Vector3d::Zero();  ///< m
  std::vector<Point> points;
};

/// Number of beams by what became of them.
struct BeamCounts {
  std::size_t all = 0;           ///< with a valid range
  std::size_t mixed = 0;         ///< on the edge between two surfaces
  std::size_t without_pose = 0;  ///< outside the trajectory, or in a gap of it
  std::size_t out_of_range = 0;  ///< nearer or farther than the parameters allow
};
BeamCounts operator+(const BeamCounts& a, const BeamCounts& b);

/// A chunk in the map.
struct RenderedChunk {
  struct Part {
    Tile tile;
    std::vector<MapCell> cells;
  };
  std::vector<Part> parts;  ///< in the order of the tiles, cells in the order of z, y, x, those of stereo last
  BeamCounts beams;
};

/// Renders scans along a trajectory, each beam at its own time, and averages the ends that fall into one cube of the
/// map's grid; points of dense stereo apart from them, without those less certain than Parameters::stereo_sigma. Ends
/// beyond the grid (50 km, 1.6 km in height for cubes of 5 cm) count as out of range. Thread-safe.
RenderedChunk renderChunk(const Parameters& parameters, const urban_nav_core::Trajectory& T_map_base,
                          const std::vector<LaserInput>& lasers, const std::vector<StereoFrame>& stereo,
                          urban_nav_core::StampNs begin);

}  // namespace laser_mapper
