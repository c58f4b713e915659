// SPDX-License-Identifier: BSD-3-Clause
#include "world/world.hpp"

#include <algorithm>

#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"
#include "world/worlds.hpp"

namespace urban_nav_sim {

using Eigen::Vector2d;

std::vector<std::string> townNames() { return {"quad", "begbroke", "street"}; }

std::vector<std::string> worldNames() {
  std::vector<std::string> names = townNames();
  names.insert(names.end(), {"tunnel", "ribbed_tunnel", "corridor", "field"});
  return names;
}

namespace {

World buildByDay(const std::string& world, std::uint32_t seed, int day) {
  if (world == "quad") return buildQuad(seed, day);
  if (world == "begbroke") return buildBegbroke(seed, day);
  if (world == "street") return buildStreet(seed, day);
  if (world == "tunnel" || world == "ribbed_tunnel") return buildTunnel(seed, day, world == "ribbed_tunnel");
  if (world == "corridor") return buildCorridor(seed, day);
  if (world == "field") return buildField(seed, day);
  throw urban_nav_core::UserError("world", "\"" + world + "\"", urban_nav_core::joined(worldNames()));
}

std::vector<Route> fastRoutes(const std::string& world, std::uint32_t seed) {
  if (world == "quad") return routesOfQuad(seed);
  if (world == "begbroke") return routesOfBegbroke(seed);
  if (world == "street") return routesOfStreet(seed);
  if (world == "tunnel" || world == "ribbed_tunnel") return routesOfTunnel();
  if (world == "corridor") return routesOfCorridor(seed);
  if (world == "field") return routesOfField(seed);
  throw urban_nav_core::UserError("world", "\"" + world + "\"", urban_nav_core::joined(worldNames()));
}

/// Returns the same route with a very slow start.
Route creeping(const Route& route) {
  Route slow = route;
  slow.name = "creep";
  slow.summary = "loops, the first half a metre at 2 cm/s";
  const Vector2d first = route.waypoints[0].position, towards = (route.waypoints[1].position - first).normalized();
  slow.waypoints.insert(slow.waypoints.begin() + 1, {Vector2d(first + 0.5 * towards), 0.02, 0.0});
  return slow;
}

}  // namespace

World buildWorld(const std::string& world, std::uint32_t seed, int day, Light light) {
  World built = buildByDay(world, seed, day);
  built.day = makeDay(seed, day, light);
  return built;
}

std::vector<Route> worldRoutes(const std::string& world, std::uint32_t seed) {
  std::vector<Route> routes = fastRoutes(world, seed);
  routes.push_back(creeping(routes.front()));
  return routes;
}

std::vector<Waypoint> through(const std::vector<Vector2d>& places, double speed) {
  std::vector<Waypoint> result;
  for (const Vector2d& p : places) result.push_back({p, speed, 0.0});
  return result;
}

std::vector<Waypoint> backwards(const std::vector<Waypoint>& waypoints) {
  return {waypoints.rbegin(), waypoints.rend()};
}

std::vector<Vector2d> rounded(std::vector<Vector2d> line, bool closed) {
  for (int round = 0; round < 2; ++round) {
    std::vector<Vector2d> next;
    const std::size_t n = line.size();
    if (!closed) next.push_back(line.front());
    for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
      const Vector2d &a = line[i], &b = line[(i + 1) % n];
      next.push_back(0.75 * a + 0.25 * b);
      next.push_back(0.25 * a + 0.75 * b);
    }
    if (!closed) next.push_back(line.back());
    line = std::move(next);
  }
  return line;
}

}  // namespace urban_nav_sim
