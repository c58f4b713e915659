// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/point_cloud.hpp"

namespace urban_nav_core::testing {

using urban_nav_core::Pose;

/// Upright block, rotated about z. A world consists of blocks and the ground z = 0.
struct Block {
  double x, y;           // middle, m
  double length, width;  // along its own axes, m
  double bottom, top;    // m
  double heading;        // rad
};
/// Blocks on level ground.
struct World {
  std::vector<Block> blocks;
  bool ground = true;
};

/// Courtyard of four fronts with bays, with trees, cars and a kiosk, different for each seed.
World courtyard(std::uint64_t seed);
/// One straight featureless front, and the ground before it.
World facade();
/// Ground without blocks.
World plain();
/// Beams, field of view and noise of a simulated 3D LiDAR.
struct Scanner {
  int rings = 32, beams = 900;            // per ring, all around
  double lowest = -25.0, highest = 12.0;  // deg
  double range = 60.0, sigma = 0.015;     // m
};

/// Returns the scan of a spinning laser at T_world_sensor, in its frame. Rays are intersected with each block; shares
/// no code with the estimator.
urban_nav_core::PointCloud scan(const World& world, const Pose& T_world_sensor, const Scanner& scanner,
                                std::uint64_t seed);

/// Returns the pose of a sensor 1.5 m above the ground.
Pose stand(double x, double y, double heading_deg, double roll_deg = 0.0, double pitch_deg = 0.0);

}  // namespace urban_nav_core::testing
