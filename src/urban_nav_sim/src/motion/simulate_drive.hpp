// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "motion/motion.hpp"
#include "world/world.hpp"

namespace urban_nav_sim {

struct DriveOptions {
  double duration = 60.0;    ///< s
  std::uint64_t seed = 1;    ///< of hand and ground: two rides of one route are never equal
  double start = 0.0;        ///< m along the route at which the motion begins; longer ones begin in a later round
  double wander = 0.08;      ///< how far the driver strays to the side of the straight way, m (standard deviation)
  double roughness = 1.0;    ///< of the ground under the wheels: 0 as World::ground is, 0.5 paving, 1 gravel
  double oscillation = 1.0;  ///< of the pendulum: 0 none, 1 some 0.3 deg of pitch
};

/// Drives a route as a person drives a Segway: the wheels roll over World::ground, the body balances above them as an
/// inverted pendulum. The robot stands at the start of the route at t = 0, in its direction. A route that ends before
/// the duration is driven on from its start if it ends within kClosed of it, else back the way it came, and again.
/// World and route are not needed afterwards. Throws UserError for a route that leads nowhere (all of it within 0.5 m).
std::unique_ptr<Motion> simulateDrive(const World& world, const Route& route, const DriveOptions& options);

constexpr double kClosed = 2.0;        ///< m
constexpr double kWheelRadius = 0.24;  ///< m, of a Segway RMP200
constexpr double kTrack = 0.54;        ///< m from wheel to wheel
constexpr double kTopSpeed = 1.30;     ///< m/s that is steered for; Tables 2 and 3 have up to 1.53
constexpr double kTopTurn = 1.13;      ///< rad/s that is steered for; Tables 2 and 3 have up to 75 deg/s

}  // namespace urban_nav_sim
