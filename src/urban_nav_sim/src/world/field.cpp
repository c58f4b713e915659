// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "noise/hash.hpp"
#include "world/props.hpp"
#include "world/site.hpp"
#include "world/terrain.hpp"
#include "world/worlds.hpp"

namespace urban_nav_sim {

using Eigen::Vector2d;

namespace {

constexpr double kHalfField = 240.0;  // m
constexpr double kHalfBelt = 210.0;   // m: trees, beyond the range of lasers from every route
constexpr double kFieldCell = 6.0;    // m

}  // namespace

World buildField(std::uint32_t seed, int day) {
  World world;
  world.name = "field";
  world.day = makeDay(seed, day);
  world.ground = [](double, double) { return 0.0; };
  Site site(world, seed);
  const Finish meadow{MaterialKind::Meadow, 1, seed % 97};
  for (double x = -kHalfField; x < kHalfField; x += kFieldCell)
    for (double y = -kHalfField; y < kHalfField; y += kFieldCell)
      site.quad(meadow, {x, y, 0}, {x + kFieldCell, y, 0}, {x + kFieldCell, y + kFieldCell, 0}, {x, y + kFieldCell, 0},
                {x, y});
  const double b = kHalfBelt;
  plantBelt(site, {{-b, -b}, {b, -b}, {b, b}, {-b, b}, {-b, -b}}, seed);
  return world;
}

std::vector<Route> routesOfField(std::uint32_t seed) {
  Draw draw(hash(seed, 0xF1E));
  const double a = draw.uniform(36, 44), b = draw.uniform(26, 32);
  const std::vector<Vector2d> round = {{0, 0}, {a, 0}, {a, b}, {0, b}};
  std::vector<Vector2d> loops = round, orbits4;
  for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(a, 0), Vector2d(0, 0)}) loops.push_back(corner);
  for (int i = 0; i < 4; ++i) orbits4.insert(orbits4.end(), round.begin(), round.end());
  orbits4.emplace_back(0, 0);
  return {{"loops", "round a rectangle, along its first side again and back", through(loops)},
          {"orbits4", "four times round the rectangle", through(orbits4)},
          {"reversed", "loops from its end to its start", backwards(through(loops))}};
}

}  // namespace urban_nav_sim
