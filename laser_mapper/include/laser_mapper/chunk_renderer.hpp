// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "laser_mapper/depth_frame.hpp"
#include "laser_mapper/map_cell.hpp"
#include "laser_mapper/parameters.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_store/tables/lidar_sweep.hpp"

namespace laser_mapper {

/// Duration of a chunk. Chunks begin at multiples of it, so that a recording has the same chunks in every run.
constexpr urban_nav_core::StampNs kChunkNs = 4'000'000'000;

/// Returns the beginning of the chunk that contains a stamp.
urban_nav_core::StampNs chunkBegin(urban_nav_core::StampNs stamp);

/// Scans of one laser.
struct LaserInput {
  urban_nav_core::Pose T_base_laser;
  int laser = 0;  ///< sensor id (sensors.hpp)
  std::vector<urban_nav_core::Scan> scans;
};

/// Sweeps of one 3D LiDAR.
struct LidarInput {
  urban_nav_core::Pose T_base_lidar;
  std::uint8_t sensor = 0;                                                 ///< id (sensors.hpp)
  std::vector<std::shared_ptr<const urban_nav_store::LidarSweep>> sweeps;  ///< of the chunk
  /// A subset of the sweeps of the chunk and of the seconds around it, as evidence of free space.
  std::vector<std::shared_ptr<const urban_nav_store::LidarSweep>> evidence;
};

/// Points of dense stereo of one stereo pair.
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

/// Numbers of beams by result.
struct BeamCounts {
  std::size_t all = 0;           ///< with a valid range
  std::size_t mixed = 0;         ///< on the edge between two surfaces
  std::size_t without_pose = 0;  ///< outside the trajectory, or in a gap
  std::size_t out_of_range = 0;  ///< outside the range of the parameters
};
BeamCounts operator+(const BeamCounts& a, const BeamCounts& b);

/// Rendered chunk of the map.
struct RenderedChunk {
  struct Part {
    Tile tile;
    std::vector<MapCell> cells;
  };
  std::vector<Part> parts;  ///< in the order of the tiles; cells in the order of z, y, x, those of stereo last
  BeamCounts beams;
};

/// Measurements of a chunk.
struct ChunkInput {
  std::vector<LaserInput> lasers;
  std::vector<LidarInput> lidars;
  std::vector<StereoFrame> stereo;  ///< points that fill areas without laser points, in sessions with planar lasers
  std::vector<std::shared_ptr<const DepthFrame>> views;  ///< depth images of the chunk and of the seconds around it
};

/// Time before and after a chunk whose depth images and sweeps are used as evidence.
constexpr urban_nav_core::StampNs kEvidenceNs = 2'000'000'000;

/// Renders measurements along a trajectory, each at its own time, and averages beam ends within each voxel of the map's
/// grid. Voxels of a 3D LiDAR are ghosts if more sweeps of `evidence` see through them than see them occupied. Points
/// of dense stereo are stored separately from those of lasers: from `stereo`, those with a sigma below
/// Parameters::stereo_sigma; from `views`, points on which several agree, weighted by inverse variance. Ends beyond the
/// grid (50 km, 1.6 km in height for voxels of 5 cm) count as out of range. Throws DataError for damaged sweeps.
/// Thread-safe.
RenderedChunk renderChunk(const Parameters& parameters, const urban_nav_core::Trajectory& T_map_base,
                          const ChunkInput& input, urban_nav_core::StampNs begin);

}  // namespace laser_mapper
