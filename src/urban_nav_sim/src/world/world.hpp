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

/// Triangles of one look, as the ray tracer takes them. Plain data.
struct Part {
  std::vector<Eigen::Vector3f> vertices;                ///< m, in `world` (of a Mover: in its own frame)
  std::vector<Eigen::Vector2f> texture;                 ///< m along the surface, one for each vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise as seen from outside
  std::uint32_t material = 0;                           ///< index of World::materials
  std::uint32_t seed = 0;                               ///< what this one looks like among its kind
};

/// Something that moves as one rigid piece.
struct Mover {
  std::vector<Part> parts;
  std::function<urban_nav_core::Pose(double t)> T_world_mover;  ///< at a time of the session, s
};

/// Next waypoint of a route. Speeds are targets: the robot slows down for turns by itself.
struct Waypoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, in `world`
  double speed = 1.2;                                  ///< m/s on the way to it
  double pause = 0.0;                                  ///< s that the robot stands there
};

/// What was built for one seed and one day. `world`: z up, z = 0 near where the robot starts, the same on all days.
/// Immutable once built, so thread-safe.
struct World {
  std::string name;
  Day day;
  std::vector<Material> materials;
  std::vector<Part> parts;
  std::vector<Mover> movers;
  std::function<double(double x, double y)> ground;  ///< height (m) of what wheels roll on; twice differentiable
};

/// A way through a world, named for the command line; it is driven again from its start where it ends too early.
struct Route {
  std::string name, summary;
  std::vector<Waypoint> waypoints;
};

/// Names for the command line, in the order of --help.
std::vector<std::string> worldNames();
/// The worlds with streets, plants and every class of surface.
std::vector<std::string> townNames();
/// The routes of a world. `world` is one of worldNames().
std::vector<Route> worldRoutes(const std::string& world, std::uint32_t seed);
/// `day`: 1, 2, ...: the same place in other weather, with other vehicles and people.
World buildWorld(const std::string& world, std::uint32_t seed, int day);

}  // namespace urban_nav_sim
