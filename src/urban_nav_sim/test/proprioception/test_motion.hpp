// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>

#include "motion/simulate_drive.hpp"

namespace urban_nav_sim {

/// A loop of 60 m for tests of what is on the robot; hills of up to 10 % where asked for.
inline std::unique_ptr<Motion> testMotion(double duration, bool hills = true, double roughness = 1.0) {
  World world;
  world.ground = [hills](double x, double y) { return hills ? 0.6 * std::sin(0.15 * x) * std::cos(0.11 * y) : 0.0; };
  Route route;
  route.name = "test";
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {20.0, 0.0}, {20.0, 12.0}, {8.0, 12.0}, {0.0, 6.0}, {0.0, 0.0}}) {
    Waypoint waypoint;
    waypoint.position = {x, y};
    route.waypoints.push_back(waypoint);
  }
  DriveOptions options;
  options.duration = duration;
  options.roughness = roughness;
  return simulateDrive(world, route, options);
}

}  // namespace urban_nav_sim
