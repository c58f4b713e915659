// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "noise/hash.hpp"
#include "world/building.hpp"
#include "world/props.hpp"
#include "world/site.hpp"
#include "world/worlds.hpp"

namespace urban_nav_sim {

using Eigen::Vector2d;
using Eigen::Vector3d;
using urban_nav_core::Pose;

namespace {

constexpr double kHalf = 1.4;           // half the width of the corridor, m
constexpr double kCeiling = 2.7;        // m
constexpr double kBelowCeiling = 0.12;  // m, of the light of a lamp
constexpr double kDoorWidth = 0.95, kDoorHeight = 2.1;

/// A corridor around a block, determined by the seed; its centre line passes through the origin.
struct CorridorPlan {
  double length, depth;  ///< of the rectangle of the centre line

  explicit CorridorPlan(std::uint32_t seed) {
    Draw draw(hash(seed, 0xC0D));
    length = draw.uniform(36, 44);
    depth = draw.uniform(16, 20);
  }
  Extent outer() const { return {-10.0 - kHalf, -kHalf, length - 10.0 + kHalf, depth + kHalf}; }
  Extent inner() const { return {-10.0 + kHalf, kHalf, length - 10.0 - kHalf, depth - kHalf}; }
};

/// Returns the doors of a wall at irregular intervals: closed ones in frames, some open to niches.
std::vector<Opening> placeDoors(double length, Draw& draw) {
  std::vector<Opening> doors;
  for (double u = draw.uniform(1.6, 3.0); u + kDoorWidth < length - 1.7; u += draw.uniform(2.4, 5.2)) {
    Opening door{u, u + kDoorWidth, 0.0, kDoorHeight, draw.chance(0.25) ? draw.uniform(0.6, 1.6) : 0.12, {}};
    door.filling = {MaterialKind::Door, static_cast<std::uint64_t>(draw.index(4)),
                    static_cast<std::uint32_t>(draw.index(1000))};
    doors.push_back(door);
  }
  return doors;
}

/// Adds a lift with two sliding leaves, which are open, hidden by the wall, for almost half of each period (s). The
/// cabin is a niche in the wall.
void addLift(Site& site, const Vector2d& start, const Vector2d& along, const Opening& cabin, double period,
             double phase) {
  const Vector2d out(along.y(), -along.x());
  const double half = 0.5 * (cabin.u1 - cabin.u0);
  for (const double side : {-1.0, 1.0}) {
    site.beginMover();
    site.box({MaterialKind::PaintedWood, 2, 9}, {0, 0, 0}, {half, 0.04, kDoorHeight});
    const Vector2d closed = start + (0.5 * (cabin.u0 + cabin.u1) + 0.5 * side * half) * along - 0.1 * out;
    const double yaw = std::atan2(along.y(), along.x());
    const Vector2d step = side * (half - 0.02) * along;
    site.release([closed, step, yaw, period, phase](double t) {
      const double cycle = t / period + phase, f = cycle - std::floor(cycle);
      const double opened = std::clamp(std::min(f, 0.5 - f) * period / 1.5, 0.0, 1.0);
      const Vector2d place = closed + opened * step;
      return Pose(Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ())), Vector3d(place.x(), place.y(), 0.0));
    });
  }
}

/// Adds the walls of a rectangle, visible from outside (the inner block) or inside; a lift in the middle of the first.
void addWalls(Site& site, const Extent& e, bool from_inside, std::uint32_t seed) {
  std::array<Vector2d, 4> corners = {Vector2d(e.x0, e.y0), Vector2d(e.x1, e.y0), Vector2d(e.x1, e.y1),
                                     Vector2d(e.x0, e.y1)};
  if (from_inside) std::reverse(corners.begin(), corners.end());
  const Finish trim{MaterialKind::PaintedWood, 1, 2};
  for (std::size_t side = 0; side < 4; ++side) {
    Draw draw(hash(seed, side, from_inside ? 0x0D1 : 0x0D2));
    const Vector2d start = corners[side], span = corners[(side + 1) % 4] - start;
    const double length = span.norm();
    const Vector2d along = span / length;
    const Finish wall{side % 2 == 0 ? MaterialKind::Render : MaterialKind::Brick, draw.bits() % 3,
                      static_cast<std::uint32_t>(draw.index(500))};
    std::vector<Opening> doors = placeDoors(length, draw);
    if (!from_inside && side == 0 && doors.size() > 1) {
      Opening& cabin = doors[doors.size() / 2];
      cabin.depth = 1.5;
      addLift(site, start, along, cabin, 14.0, draw.uniform());
    }
    buildWall(site, wall, trim, start, along, length, 0.0, kCeiling, doors);
  }
}

/// Adds a section of floor and ceiling.
void addStorey(Site& site, const Extent& e) {
  const Finish floor{MaterialKind::Slabs, 1, 4}, ceiling{MaterialKind::Render, 2, 5};
  constexpr double kCell = 4.0;
  for (double x = e.x0; x < e.x1; x += kCell) {
    for (double y = e.y0; y < e.y1; y += kCell) {
      const double x1 = std::min(x + kCell, e.x1), y1 = std::min(y + kCell, e.y1);
      site.quad(floor, {x, y, 0}, {x1, y, 0}, {x1, y1, 0}, {x, y1, 0}, {x, y});
      site.quad(ceiling, {x, y1, kCeiling}, {x1, y1, kCeiling}, {x1, y, kCeiling}, {x, y, kCeiling}, {x, y});
    }
  }
}

/// Adds cabinets along the outer walls, radiators along the inner ones, lamps at the ceiling.
void furnish(Site& site, const CorridorPlan& p, std::uint32_t seed) {
  Draw draw(hash(seed, 0xF04));
  const Extent outer = p.outer();
  const Finish metal{MaterialKind::PaintedWood, 3, 7}, lamp{MaterialKind::PaintedWood, 1, 8};
  for (double x = outer.x0 + draw.uniform(4, 8); x < outer.x1 - 4; x += draw.uniform(6, 12)) {
    site.box(metal, {x, outer.y0 + 0.17, 0}, {draw.uniform(0.8, 1.2), 0.34, draw.uniform(0.9, 1.9)});
    site.box(metal, {x + draw.uniform(-2, 2), outer.y1 - 0.17, 0}, {draw.uniform(0.6, 1.2), 0.34, 0.6});
  }
  for (const double y : {0.0, p.depth})
    for (double x = outer.x0 + 2; x < outer.x1 - 2; x += 4.5) {
      site.box(lamp, {x, y, kCeiling - 0.08}, {1.2, 0.2, 0.08});
      site.lamp({x, y, kCeiling - kBelowCeiling}, Bulb::Neutral);
    }
  for (const double x : {-10.0, p.length - 10.0})
    for (double y = 3; y < p.depth - 2; y += 4.5) {
      site.box(lamp, {x, y, kCeiling - 0.08}, {0.2, 1.2, 0.08});
      site.lamp({x, y, kCeiling - kBelowCeiling}, Bulb::Neutral);
    }
}

}  // namespace

World buildCorridor(std::uint32_t seed, int day) {
  World world;
  world.name = "corridor";
  world.day = makeDay(seed, day);
  world.ground = [](double, double) { return 0.0; };
  const CorridorPlan p(seed);
  Site site(world, seed);
  const Extent outer = p.outer(), inner = p.inner();
  // Floor and ceiling extend under the walls into the niches of the doors.
  constexpr double kNiche = 1.7;
  addStorey(site, {outer.x0 - kNiche, outer.y0 - kNiche, outer.x1 + kNiche, inner.y0 + kNiche});
  addStorey(site, {outer.x0 - kNiche, inner.y1 - kNiche, outer.x1 + kNiche, outer.y1 + kNiche});
  addStorey(site, {outer.x0 - kNiche, inner.y0 + kNiche, inner.x0 + kNiche, inner.y1 - kNiche});
  addStorey(site, {inner.x1 - kNiche, inner.y0 + kNiche, outer.x1 + kNiche, inner.y1 - kNiche});
  addWalls(site, inner, false, seed);
  addWalls(site, outer, true, seed);
  furnish(site, p, seed);
  Draw draw(hash(seed, 0xDA8, static_cast<std::uint64_t>(day)));
  const int people = day == 1 ? 2 : 3 + draw.index(3);
  for (int i = 0; i < people; ++i) {
    const double y = draw.chance(0.5) ? 0.85 : p.depth - 0.85;
    sendWalker(site, {{-9.0, y}, {p.length - 11.0, y}}, draw.uniform(0.9, 1.4), draw.uniform(), draw.bits());
  }
  return world;
}

std::vector<Route> routesOfCorridor(std::uint32_t seed) {
  const CorridorPlan p(seed);
  const double x0 = -10.0, x1 = p.length - 10.0, d = p.depth;
  const std::vector<Vector2d> round = {{0, 0}, {x1, 0}, {x1, d}, {x0, d}, {x0, 0}};
  std::vector<Vector2d> loops = round, orbits4;
  for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(x1 - 3, 0), Vector2d(0, 0)}) loops.push_back(corner);
  for (int i = 0; i < 4; ++i) orbits4.insert(orbits4.end(), round.begin(), round.end());
  orbits4.emplace_back(0, 0);
  return {{"loops", "round the corridor, along its first side again and back", through(loops)},
          {"orbits4", "four times round the corridor", through(orbits4)},
          {"reversed", "loops from its end to its start", backwards(through(loops))}};
}

}  // namespace urban_nav_sim
