// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "motion/motion.hpp"
#include "world/world.hpp"

namespace urban_nav_sim {

struct DriveOptions {
  double duration = 60.0;    ///< s
  std::uint64_t seed = 1;    ///< of driver and ground: two drives of one route differ
  double start = 0.0;        ///< m along the route at which the motion begins; beyond its length, in a later round
  double wander = 0.08;      ///< lateral deviation of the driver from the route, m (standard deviation)
  double roughness = 1.0;    ///< of the ground: 0 World::ground unchanged, 0.5 paving, 1 gravel
  double oscillation = 1.0;  ///< of the pendulum: 0 none, 1 about 0.3 deg of pitch
};

/// Simulates a person who drives a Segway along a route: the wheels roll over World::ground, the body balances above
/// them as an inverted pendulum. At t = 0 the robot is at rest at the start of the route, in its direction. A route
/// that ends before the duration is repeated if it ends within kClosed of its start, otherwise driven back and forth.
/// World and route are not needed afterwards. Throws UserError for a route that lies within 0.5 m.
std::unique_ptr<Motion> simulateDrive(const World& world, const Route& route, const DriveOptions& options);

constexpr double kClosed = 2.0;        ///< m
constexpr double kWheelRadius = 0.24;  ///< m, Segway RMP200
constexpr double kTrack = 0.54;        ///< m between the wheels
constexpr double kTopSpeed = 1.30;     ///< m/s, commanded; Tables 2 and 3 state up to 1.53
constexpr double kTopTurn = 1.13;      ///< rad/s, commanded; Tables 2 and 3 state up to 75 deg/s

}  // namespace urban_nav_sim
