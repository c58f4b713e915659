// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "world/world.hpp"

namespace urban_nav_sim {

/// Builders of each world: ground, objects of a day, and routes.
World buildQuad(std::uint32_t seed, int day);
World buildStreet(std::uint32_t seed, int day);
World buildBegbroke(std::uint32_t seed, int day);
/// `has_ribs`: every 20 m (ribbed_tunnel); otherwise its geometry is the same everywhere.
World buildTunnel(std::uint32_t seed, int day, bool has_ribs);
World buildCorridor(std::uint32_t seed, int day);
World buildField(std::uint32_t seed, int day);
std::vector<Route> routesOfQuad(std::uint32_t seed);
std::vector<Route> routesOfStreet(std::uint32_t seed);
std::vector<Route> routesOfBegbroke(std::uint32_t seed);
std::vector<Route> routesOfTunnel();
std::vector<Route> routesOfCorridor(std::uint32_t seed);
std::vector<Route> routesOfField(std::uint32_t seed);

/// Helpers of routes: waypoints through positions, and the same in reverse.
std::vector<Waypoint> through(const std::vector<Eigen::Vector2d>& places, double speed = 1.25);
std::vector<Waypoint> backwards(const std::vector<Waypoint>& waypoints);
/// Returns the line with corners rounded twice (Chaikin 1974). `closed`: the last point is joined to the first.
std::vector<Eigen::Vector2d> rounded(std::vector<Eigen::Vector2d> line, bool closed);

}  // namespace urban_nav_sim
