// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ghosts/chunk_beams.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper {

/// The shortest ranges of a sweep of a 3D LiDAR by ring and azimuth, and where the sensor was when it measured them:
/// whether beams passed through a point. Of rings that are not cones about the sensor's z axis it knows nothing.
/// Immutable, so thread-safe.
class SweepView {
 public:
  /// `rings`: beams of each ring. `T_frame_map`: of the frame that classify() takes points in. Parts of the sweep at
  /// times without a pose are left out.
  SweepView(const std::vector<urban_nav_core::Scan>& rings, const urban_nav_core::Trajectory& T_map_base,
            const urban_nav_core::Pose& T_base_lidar, const urban_nav_core::Pose& T_frame_map,
            urban_nav_core::StampNs max_gap);

  /// Returns Through if the beams around the point's direction, of the ring above and of the one below, all ended at
  /// least 0.3 m farther away; Hit if one ended within 0.3 m of its distance; None otherwise.
  Sight classify(const Eigen::Vector3d& p_frame) const;

 private:
  static constexpr std::size_t kSectors = 36;
  struct Ring {
    float elevation = 0.0F;     ///< rad, mean
    std::vector<float> ranges;  ///< m, by azimuth; 0: no beam
  };
  void addRing(const urban_nav_core::Scan& beams);

  std::vector<Ring> rings_;  ///< ascending by elevation
  /// Pose of the frame in that of the sensor when it measured each sector of azimuths.
  std::array<std::optional<urban_nav_core::Pose>, kSectors> T_lidar_frame_;
  std::optional<urban_nav_core::Pose> T_lidar_frame_middle_;
};

}  // namespace laser_mapper
