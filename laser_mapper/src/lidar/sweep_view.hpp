// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ghosts/chunk_beams.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper {

/// Shortest ranges of a 3D LiDAR sweep by ring and azimuth with the sensor's poses, for tests whether beams passed
/// through a point. Rings that are not cones about the sensor's z axis are ignored. Immutable, hence thread-safe.
class SweepView {
 public:
  /// `rings`: beams of each ring. `T_frame_map`: to the frame of classify(). Parts of the sweep at times without a pose
  /// are ignored.
  SweepView(const std::vector<urban_nav_core::Scan>& rings, const urban_nav_core::Trajectory& T_map_base,
            const urban_nav_core::Pose& T_base_lidar, const urban_nav_core::Pose& T_frame_map,
            urban_nav_core::StampNs max_gap);

  /// Returns Through if the beams around the point's direction, in the rings above and below, all ended at least 0.3 m
  /// farther away; Hit if one ended within 0.3 m of its distance; None otherwise.
  Sight classify(const Eigen::Vector3d& p_frame) const;

 private:
  static constexpr std::size_t kSectors = 36;
  struct Ring {
    float elevation = 0.0F;     ///< rad, mean
    std::vector<float> ranges;  ///< m, by azimuth; 0: no beam
  };
  void addRing(const urban_nav_core::Scan& beams);

  std::vector<Ring> rings_;  ///< ascending by elevation
  /// Pose of the frame relative to the sensor during each azimuth sector.
  std::array<std::optional<urban_nav_core::Pose>, kSectors> T_lidar_frame_;
  std::optional<urban_nav_core::Pose> T_lidar_frame_middle_;
};

}  // namespace laser_mapper
