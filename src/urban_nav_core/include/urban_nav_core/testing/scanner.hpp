// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/point_cloud.hpp"

namespace urban_nav_core::testing {

using urban_nav_core::Pose;

/// An upright block, turned about z. With the ground z = 0 it is all that there is in these worlds.
struct Block {
  double x, y;           // middle, m
  double length, width;  // along its own axes, m
  double bottom, top;    // m
  double heading;        // rad
};
struct World {
  std::vector<Block> blocks;
  bool ground = true;
};

/// A courtyard of four fronts with bays, with trees, cars and a kiosk in it: no two seeds alike.
World courtyard(std::uint64_t seed);
/// One straight front without a feature, and the ground before it.
World facade();
/// Ground alone.
World plain();

struct Scanner {
  int rings = 32, beams = 900;            // per ring, all around
  double lowest = -25.0, highest = 12.0;  // deg
  double range = 60.0, sigma = 0.015;     // m
};

/// What a spinning laser at T_world_sensor sees, in its frame. Rays against blocks, one by one; shares nothing with the
/// estimator.
urban_nav_core::PointCloud scan(const World& world, const Pose& T_world_sensor, const Scanner& scanner,
                                std::uint64_t seed);

/// A sensor 1.5 m above the ground.
Pose stand(double x, double y, double heading_deg, double roll_deg = 0.0, double pitch_deg = 0.0);

}  // namespace urban_nav_core::testing
