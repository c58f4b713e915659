// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "support/rendered_depth.hpp"
#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_store/tables/lidar_sweep.hpp"

namespace laser_mapper::testing_room {

/// A LiDAR 1.3 m up, with the axes of the robot.
inline Pose roomLidar() { return Pose(Eigen::Quaterniond::Identity(), Vector3d(0.1, 0.0, 1.3)); }

/// A sweep of 0.1 s around `reference`: 24 rings from -30 to +16 deg, a beam each half degree, clockwise from
/// backwards. Beams at times without a pose have the range of the first one.
inline urban_nav_core::Sweep sweepOfScene(const Scene& scene, const urban_nav_core::Trajectory& T_map_base,
                                          StampNs reference) {
  urban_nav_core::Sweep sweep;
  sweep.reference = reference;
  sweep.duration = 0.1;
  sweep.times = urban_nav_core::Sweep::Times::Measured;
  for (int column = 0; column < 720; ++column)
    for (int ring = 0; ring < 24; ++ring) {
      urban_nav_core::Beam beam;
      beam.stamp = reference + (column - 360) * 138'888;
      const double azimuth = (179.75 - 0.5 * column) * M_PI / 180.0, elevation = (2.0 * ring - 30.0) * M_PI / 180.0;
      const Vector3d direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                               std::sin(elevation));
      const Pose T_map_lidar = T_map_base.at(beam.stamp, 1'000'000'000).value_or(T_map_base.front().pose) * roomLidar();
      beam.direction = direction.cast<float>();
      beam.range = static_cast<float>(scene(T_map_lidar.t(), T_map_lidar.q() * direction));
      beam.intensity = 50.0F;
      beam.ring = static_cast<std::uint16_t>(ring);
      beam.column = static_cast<std::uint16_t>(column);
      sweep.beams.push_back(beam);
    }
  return sweep;
}

/// Returns the beams of each ring, as the store returns them.
inline std::vector<urban_nav_core::Scan> toRings(const urban_nav_core::Sweep& sweep) {
  return urban_nav_store::LidarSweep{"", "points0", sweep.reference, urban_nav_store::LidarSweep::pack(sweep)}.rings();
}

}  // namespace laser_mapper::testing_room
