// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "materials/material.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "world/day.hpp"

namespace urban_nav_sim {

/// Triangles of one appearance, as input of the ray tracer. Plain data.
struct Part {
  std::vector<Eigen::Vector3f> vertices;                ///< m, in `world` (of a Mover: in its own frame)
  std::vector<Eigen::Vector2f> texture;                 ///< m along the surface, one per vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise as seen from outside
  std::uint32_t material = 0;                           ///< index of World::materials
  std::uint32_t seed = 0;                               ///< seed of this instance
};

/// A moving rigid object.
struct Mover {
  std::vector<Part> parts;
  std::function<urban_nav_core::Pose(double t)> T_world_mover;  ///< at a time of the session, s
};

/// Waypoint of a route. Speeds are targets: the robot slows down for turns.
struct Waypoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, in `world`
  double speed = 1.2;                                  ///< m/s towards it
  double pause = 0.0;                                  ///< s that the robot rests at it
};

/// An electric light, at its place whether it burns or not. It has no geometry of its own.
struct Lamp {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();   ///< m, in `world`
  Eigen::Vector3f intensity = Eigen::Vector3f::Zero();  ///< radiance of a white surface 1 m below it that faces it, RGB
};

/// A window of a house, by the first corner of its pane.
struct Window {
  Eigen::Vector3f corner = Eigen::Vector3f::Zero();  ///< m, in `world`; the first vertex of its triangles
  std::uint32_t house = 0;                           ///< number of the house
};

/// A world for one seed and one day. `world`: z up, z = 0 near the start of the robot, the same on all days. Immutable
/// once built, so thread-safe.
struct World {
  std::string name;
  Day day;
  std::vector<Material> materials;
  std::vector<Part> parts;
  std::vector<Mover> movers;
  std::vector<Lamp> lamps;
  std::vector<Window> windows;
  std::function<double(double x, double y)> ground;  ///< height (m) of the drivable ground; twice differentiable
};

/// A named path through a world; repeated from its start if it is too short.
struct Route {
  std::string name, summary;
  std::vector<Waypoint> waypoints;
};

/// Returns the names for the command line in the order of --help.
std::vector<std::string> worldNames();
/// Returns the worlds with streets, plants and every class of surface.
std::vector<std::string> townNames();
/// Returns the routes of a world. `world` is one of worldNames().
std::vector<Route> worldRoutes(const std::string& world, std::uint32_t seed);
/// `day`: 1, 2, ...: the same static world with other weather, vehicles and people. `light` changes Day only.
World buildWorld(const std::string& world, std::uint32_t seed, int day, Light light = Light::Day);

}  // namespace urban_nav_sim
