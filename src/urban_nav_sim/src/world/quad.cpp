// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "noise/hash.hpp"
#include "world/building.hpp"
#include "world/props.hpp"
#include "world/terrain.hpp"
#include "world/worlds.hpp"

namespace urban_nav_sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kWing = 8.0;      // depth of the buildings around the quad, m
constexpr double kPath = 7.0;      // width of the gravel around the lawn
constexpr double kFromWall = 3.8;  // distance of the robot from the wall
constexpr double kArch = 3.6;      // width of the archway

/// Layout determined by the seed: routes need it without the world.
struct QuadPlan {
  double west, east, south, north;    ///< inner faces of the four walls
  double gate;                        ///< y of the archway in the east wing
  double garden;                      ///< x at which the gardens begin
  std::vector<Vector2d> garden_path;  ///< closed, from the archway on, rounded

  explicit QuadPlan(std::uint32_t seed) {
    Draw draw(hash(seed, 0x90AD));
    const double width = draw.uniform(37, 45), depth = draw.uniform(32, 38);
    west = -0.5 * width, east = 0.5 * width, south = -kFromWall, north = depth - kFromWall;
    gate = south + depth * draw.uniform(0.42, 0.58);
    garden = east + kWing;
    // Around the gardens (Newman et al. 2009, figure 1).
    const std::vector<Vector2d> corners = {{3, 0},    {14, -1}, {27, -3}, {33, -10}, {36, -20}, {48, -24},
                                           {60, -20}, {63, -4}, {62, 14}, {52, 21},  {40, 22},  {37, 32},
                                           {28, 38},  {12, 36}, {6, 27},  {5, 12}};
    for (const Vector2d& c : corners)
      garden_path.push_back(Vector2d(garden, gate) + c + 0.8 * Vector2d(draw.uniform(-1, 1), draw.uniform(-1, 1)));
    garden_path.front() = {garden + 3.5, gate};
    garden_path = rounded(garden_path, true);
  }

  Extent court() const { return {west, south, east, north}; }
  Extent lawn() const { return {west + kPath, south + kPath, east - kPath, north - kPath}; }
  Extent gardens() const { return {garden + 0.01, gate - 32, garden + 72, gate + 46}; }
  std::vector<Vector2d> pathLine() const {
    std::vector<Vector2d> line = garden_path;
    line.push_back(line.front());
    line.insert(line.begin(), Vector2d(east, gate));
    return line;
  }
};

void buildWings(Site& site, const QuadPlan& p, std::uint32_t seed) {
  Draw draw(hash(seed, 0xB1));
  Style style;
  style.wall = {MaterialKind::Ashlar, static_cast<std::uint64_t>(draw.index(4)), 10};
  style.window = MaterialKind::Sash, style.spacing = draw.uniform(2.9, 3.4), style.storey = draw.uniform(3.6, 4.1);
  style.trim = {MaterialKind::Ashlar, 7, 3};
  const auto wing = [&](const Extent& e, int variant) {
    style.seed = hash(seed, static_cast<std::uint64_t>(variant));
    style.wall.seed = static_cast<std::uint32_t>(100 * variant);
    style.battlements = variant % 2 == 0;
    buildHouse(site, e, style);
  };
  style.doors = {0, 0, 6, 0};
  wing({p.west - kWing, p.south - kWing, p.east + kWing, p.south}, 0);
  style.doors = {5, 0, 0, 0}, style.storeys = 3, style.storey -= 0.4;
  wing({p.west - kWing, p.north, p.east + kWing, p.north + kWing + 2}, 1);
  style.storeys = 2, style.storey += 0.4, style.doors = {0, 4, 0, 0};
  const Style stone = style;
  style.wall = {MaterialKind::Render, 1, 7}, style.window = MaterialKind::Casement;  // one side plastered
  wing({p.west - kWing, p.south, p.west, p.north}, 3);
  style = stone;
  style.doors = {0, 0, 0, 5}, style.windows = {false, true, false, true};
  wing({p.east, p.south, p.garden, p.gate - 0.5 * kArch}, 2);
  wing({p.east, p.gate + 0.5 * kArch, p.garden, p.north}, 4);
}

/// Builds a tower over the archway: a barrel vault, round arches with a ring of stones at both ends.
void buildGate(Site& site, const QuadPlan& p) {
  constexpr int kStones = 11;
  constexpr double kRing = 0.4, kProud = 0.06;  // m: width of the ring, projection from the wall
  const double radius = 0.5 * kArch, floor = site.ground(p.east + 4, p.gate);
  const double spring = floor + 2.2, low = spring + radius + 0.1, high = floor + 10.8;
  const double x0 = p.east - 0.35, x1 = p.garden + 0.35, y0 = p.gate - radius - 0.6, y1 = p.gate + radius + 0.6;
  const Finish tower{MaterialKind::Ashlar, 7, 55};
  site.box(tower, {0.5 * (x0 + x1), p.gate, low}, {x1 - x0, y1 - y0, high - low});
  const auto on_arch = [&](double x, int stone, double r) {
    const double angle = M_PI * stone / kStones;
    return Vector3d(x, p.gate - r * std::cos(angle), spring + r * std::sin(angle));
  };
  const auto over = [&](const Vector3d& q) { return Vector3d(q.x(), q.y(), low); };
  for (int i = 0; i < kStones; ++i) {
    const Finish stone{MaterialKind::Ashlar, 7, static_cast<std::uint32_t>(60 + i)};
    site.quad(tower, on_arch(x0, i + 1, radius), on_arch(x1, i + 1, radius), on_arch(x1, i, radius),
              on_arch(x0, i, radius));
    for (const double side : {-1.0, 1.0}) {
      const double x = side < 0 ? x0 : x1, out = x + side * kProud;
      const int a = side < 0 ? i + 1 : i, b = side < 0 ? i : i + 1;  // counter-clockwise as seen from outside
      const Vector3d left = on_arch(x, a, radius), right = on_arch(x, b, radius);
      site.quad(tower, over(right), over(left), left, right, {right.y(), 0});
      site.quad(stone, on_arch(out, a, radius), on_arch(out, b, radius), on_arch(out, b, radius + kRing),
                on_arch(out, a, radius + kRing), {1.7 * i, 0.4 * i});
      site.quad(stone, on_arch(out, b, radius), on_arch(out, a, radius), left, right);
      site.quad(stone, on_arch(out, a, radius + kRing), on_arch(out, b, radius + kRing), on_arch(x, b, radius + kRing),
                on_arch(x, a, radius + kRing));
    }
  }
  for (const double x : {x0 + 0.2, x1 - 0.2}) {
    for (const double y : {p.gate - radius - 0.3, p.gate + radius + 0.3})
      site.box(tower, {x, y, floor - 0.5}, {0.4, 0.6, low - floor + 0.5});
    for (double y = y0 + 0.3; y < y1; y += 1.0) site.box(tower, {x, y, high}, {0.4, 0.6, 0.7});
  }
}

void furnishCourt(Site& site, const QuadPlan& p, std::uint32_t seed) {
  Draw draw(hash(seed, 0xC0));
  const Extent c = p.court();
  // Beds with shrubs at the feet of the walls, with gaps for the doors.
  for (double x = c.x0 + 3; x < c.x1 - 6; x += draw.uniform(5, 9)) {
    const double end = x + draw.uniform(1.5, 4.0);
    const MaterialKind stuff = draw.chance(0.4)   ? MaterialKind::Flowers
                               : draw.chance(0.5) ? MaterialKind::Shrub
                                                  : MaterialKind::Hedge;
    plantHedge(site, {x, c.y1 - 0.6}, {end, c.y1 - 0.6}, 0.7, draw.uniform(0.5, 1.3), stuff, draw.bits());
  }
  for (double x = c.x0 + 4; x < c.x1 - 6; x += draw.uniform(7, 12))
    plantHedge(site, {x, c.y0 + 0.55}, {x + draw.uniform(1.2, 3), c.y0 + 0.55}, 0.6, draw.uniform(0.4, 0.9),
               MaterialKind::Flowers, draw.bits());
  for (const double t : {0.25, 0.75}) {
    placeLamp(site, c.x0 + 0.5, c.y0 + t * (c.y1 - c.y0), 0.0);
    placeBench(site, c.x0 + t * (c.x1 - c.x0), c.y0 + 0.55, M_PI);
    placeBench(site, c.x1 - 0.5, c.y0 + (t < 0.5 ? 0.2 : 0.8) * (c.y1 - c.y0), -M_PI / 2);
  }
  // Lamps at the walls, 3.2 m high, and at both ends of the archway.
  constexpr double kHeight = 3.2, kOut = 0.25;  // m
  for (const double t : {0.2, 0.5, 0.8}) {
    const double x = c.x0 + t * (c.x1 - c.x0), y = c.y0 + t * (c.y1 - c.y0);
    site.wallLamp(x, c.y0 + kOut, kHeight);
    site.wallLamp(x, c.y1 - kOut, kHeight);
    if (std::abs(y - p.gate) > kArch) site.wallLamp(c.x1 - kOut, y, kHeight);
  }
  for (const double x : {p.east - 0.6, p.garden + 0.6}) site.wallLamp(x, p.gate - 0.5 * kArch - 0.35, 2.6);
  // At the centre of the lawn: a plinth with a sundial, and a tree to one side.
  const Vector2d m(0.5 * (c.x0 + c.x1), 0.5 * (c.y0 + c.y1));
  const Vector3d foot(m.x(), m.y(), site.ground(m.x(), m.y()));
  site.box({MaterialKind::Slabs, 0, 9}, foot, {2.4, 2.4, 0.25});
  site.box({MaterialKind::Ashlar, 7, 9}, foot + Vector3d(0, 0, 0.25), {0.9, 0.9, 1.1});
  site.pole({MaterialKind::Ashlar, 7, 8}, foot + Vector3d(0, 0, 1.35), foot + Vector3d(0, 0, 3.1), 0.28, 0.2, 12);
  plantTree(site, m.x() - draw.uniform(5, 8), m.y() + draw.uniform(-3, 3), draw.uniform(6, 8), draw.bits());
  placeBin(site, c.x1 - 0.7, c.y0 + 0.7);
}

void plantGardens(Site& site, const QuadPlan& p, std::uint32_t seed) {
  Draw draw(hash(seed, 0x6A));
  const Extent g = p.gardens();
  const std::vector<Vector2d> line = p.pathLine();
  const Finish wall{MaterialKind::Rubble, 0, 4}, cap{MaterialKind::Kerb, 1, 4};
  const auto garden_wall = [&](const Vector2d& a, const Vector2d& b, double height) {
    layStrip(site, cap, wall, a, b, 0.5, height);
  };
  garden_wall({g.x0, g.y0}, {g.x1, g.y0}, 2.6), garden_wall({g.x1, g.y0}, {g.x1, g.y1}, 2.9),
      garden_wall({g.x1, g.y1}, {g.x0, g.y1}, 2.4);
  garden_wall({g.x0 + 0.25, p.south - kWing}, {g.x0 + 0.25, g.y0}, 2.6),
      garden_wall({g.x0 + 0.25, g.y1}, {g.x0 + 0.25, p.north + kWing + 2}, 2.4);
  constexpr double kLampSpacing = 16.0, kLampHeight = 2.2;  // m
  for (double y = g.y0 + 8.0; y < g.y1; y += kLampSpacing) site.wallLamp(g.x1 - 0.5, y, kLampHeight);
  for (double x = g.x0 + 8.0; x < g.x1; x += kLampSpacing) {
    site.wallLamp(x, g.y0 + 0.5, kLampHeight);
    site.wallLamp(x, g.y1 - 0.5, kLampHeight);
  }
  const auto free = [&](double x, double y, double room) { return distanceTo(line, x, y) > room; };
  for (int i = 0, planted = 0; i < 900 && planted < 34; ++i) {
    const double x = draw.uniform(g.x0 + 3, g.x1 - 2), y = draw.uniform(g.y0 + 2, g.y1 - 2),
                 height = draw.uniform(5, 13);
    if (!free(x, y, 2.4 + 0.1 * height)) continue;
    plantTree(site, x, y, height, draw.bits());
    ++planted;
  }
  for (int i = 0, planted = 0; i < 900 && planted < 60; ++i) {
    const double x = draw.uniform(g.x0 + 2, g.x1 - 2), y = draw.uniform(g.y0 + 2, g.y1 - 2),
                 angle = draw.uniform(0, M_PI), length = draw.uniform(0.8, 7.0);
    const Vector2d a(x, y), b = a + length * Vector2d(std::cos(angle), std::sin(angle));
    if (b.x() > g.x1 - 1.5 || b.y() > g.y1 - 1.5 || !free(a.x(), a.y(), 2.7) || !free(b.x(), b.y(), 2.7) ||
        !free(0.5 * (a + b).x(), 0.5 * (a + b).y(), 2.7))
      continue;
    const MaterialKind stuff =
        length < 2 ? (draw.chance(0.5) ? MaterialKind::Flowers : MaterialKind::Shrub) : MaterialKind::Hedge;
    plantHedge(site, a, b, draw.uniform(0.8, 1.5), draw.uniform(0.6, 1.9), stuff, draw.bits());
    ++planted;
  }
  for (int i = 0, placed = 0; i < 400 && placed < 7; ++i) {
    const double x = draw.uniform(g.x0 + 3, g.x1 - 3), y = draw.uniform(g.y0 + 3, g.y1 - 3);
    if (!free(x, y, 2.3) || free(x, y, 3.0)) continue;
    placeBench(site, x, y, draw.uniform(0, 6));
    ++placed;
  }
  // Houses of the town, visible above the walls.
  Style town;
  town.storeys = 3, town.spacing = 3.3;
  for (int i = 0; i < 9; ++i) {
    town.seed = draw.bits();
    town.wall = {draw.chance(0.5) ? MaterialKind::Brick : MaterialKind::Render,
                 static_cast<std::uint64_t>(draw.index(4)), static_cast<std::uint32_t>(300 + 10 * i)};
    town.roof.stuff = draw.chance(0.5) ? MaterialKind::RoofTile : MaterialKind::Slate;
    const double x = i < 5 ? g.x0 + 15.0 * i : g.x1 + 7,
                 y = i < 5 ? (i % 2 == 0 ? g.y1 + 6 : g.y0 - 16) : g.y0 + 19.0 * (i - 5), w = draw.uniform(9, 13);
    buildHouse(site, {x, y, x + w, y + 10}, town);
  }
}

/// Adds the objects of one day.
void peopleDay(Site& site, const QuadPlan& p, std::uint32_t seed, int day) {
  Draw draw(hash(seed, 0xDE, static_cast<std::uint64_t>(day)));
  const Extent c = p.court();
  // Vans at the walls, clear of the robot (1.6 m from the wall to their outer side).
  const int vans = 1 + draw.index(3);
  for (int i = 0; i < vans; ++i) {
    const double y = c.y0 + 8 + (c.y1 - c.y0 - 20) * (i + draw.uniform(0, 0.5)) / vans;
    parkCar(site, c.x0 + 1.3, y, draw.chance(0.5) ? M_PI / 2 : -M_PI / 2, draw.chance(0.5), draw.bits());
  }
  const int people = day == 1 ? 2 : 5 + draw.index(4);
  const Extent l = p.lawn();
  for (int i = 0; i < people; ++i) {
    const double y = draw.uniform(l.y0 + 2, l.y1 - 2), x = draw.uniform(l.x0 + 3, l.x1 - 3);
    const bool along = draw.chance(0.5);
    sendWalker(site,
               along ? std::vector<Vector2d>{{l.x0 + 1, y}, {l.x1 - 1, y}}
                     : std::vector<Vector2d>{{x, l.y0 + 1}, {x, l.y1 - 1}},
               draw.uniform(0.9, 1.5), draw.uniform(), draw.bits());
  }
}

}  // namespace

World buildQuad(std::uint32_t seed, int day) {
  World world;
  world.name = "quad", world.day = makeDay(seed, day), world.ground = makeGround(seed, 0.12);
  const QuadPlan plan(seed);
  Site site(world, seed);
  const std::vector<Vector2d> path = plan.pathLine();
  const Extent all{plan.west - 14, plan.gate - 44, plan.garden + 84, plan.gate + 58}, court = plan.court(),
                                                                                      lawn = plan.lawn();
  layGround(site, all,
            {{{MaterialKind::Lawn, 0, 1}, [&](double x, double y) { return insideRectangle(lawn, 5.0, x, y); }},
             {{MaterialKind::Slabs, 0, 1},
              [&](double x, double y) {
                return insideRectangle({court.x1 - 1.2, plan.gate - 3, plan.garden + 3, plan.gate + 3}, 0.5, x, y);
              }},
             {{MaterialKind::Slabs, 0, 1},
              [&](double x, double y) {
                return insideRectangle({court.x0 - 1, court.y1 - 1.6, court.x1 + 1, court.y1 + 1}, 0.0, x, y);
              }},
             {{MaterialKind::Gravel, 0, 1},
              [&](double x, double y) {
                return insideRectangle({court.x0 - 1, court.y0 - 1, court.x1 + 1, court.y1 + 1}, 0.0, x, y);
              }},
             {{MaterialKind::Soil, 0, 1}, [&](double x, double y) { return 1.6 - distanceTo(path, x, y); }},
             {{MaterialKind::Meadow, 0, 1}, nullptr}});
  laySurroundings(site, all, 60.0, {MaterialKind::Meadow, 0, 1});
  buildWings(site, plan, seed);
  buildGate(site, plan);
  furnishCourt(site, plan, seed);
  plantGardens(site, plan, seed);
  const Extent g = plan.gardens();
  plantBelt(site, {{g.x0 + 8, g.y0 - 20}, {g.x1 + 22, g.y0 - 20}, {g.x1 + 22, g.y1 + 20}, {g.x0 + 8, g.y1 + 20}}, seed);
  peopleDay(site, plan, seed, day);
  return world;
}

std::vector<Route> routesOfQuad(std::uint32_t seed) {
  const QuadPlan p(seed);
  const double x0 = p.west + kFromWall, x1 = p.east - kFromWall, y1 = p.north - kFromWall;
  const std::vector<Vector2d> orbit = {{0, 0}, {x1, 0}, {x1, y1}, {x0, y1}, {x0, 0}};
  std::vector<Vector2d> loops = orbit;
  // A second round as far as the north side, back to the archway, around the gardens, and home.
  for (const Vector2d& v : {Vector2d(0, 0), Vector2d(x1, 0), Vector2d(x1, y1), Vector2d(2, y1), Vector2d(x1, y1),
                            Vector2d(x1, p.gate), Vector2d(p.garden + 1, p.gate)})
    loops.push_back(v);
  loops.insert(loops.end(), p.garden_path.begin() + 1, p.garden_path.end());
  for (const Vector2d& v : {Vector2d(p.garden + 1, p.gate), Vector2d(x1, p.gate), Vector2d(x1, 0), Vector2d(0, 0)})
    loops.push_back(v);
  std::vector<Vector2d> orbits4, garden = {{0, 0}, {x1, 0}, {x1, p.gate}, {p.garden + 1, p.gate}};
  for (int i = 0; i < 4; ++i) orbits4.insert(orbits4.end(), orbit.begin(), orbit.end());
  orbits4.push_back({0, 0});
  garden.insert(garden.end(), p.garden_path.begin() + 1, p.garden_path.end());
  for (const Vector2d& v : {Vector2d(p.garden + 1, p.gate), Vector2d(x1, p.gate), Vector2d(x1, 0), Vector2d(0, 0)})
    garden.push_back(v);
  const std::vector<Vector2d> there_and_back = {{0, 0}, {x1, 0}, {x1, p.gate}, {x1, 0}, {0, 0}, {x0, 0}, {x0, y1}};
  return {{"loops", "round the lawn, round again and half way back, then through the archway around the gardens",
           through(loops)},
          {"orbits4", "four times round the lawn", through(orbits4)},
          {"reversed", "loops from its end to its start", backwards(through(loops))},
          {"gardens", "through the archway, around the gardens and back", through(garden)},
          {"return", "to the archway and back within a minute, then round the other half of the lawn",
           through(there_and_back)}};
}

}  // namespace urban_nav_sim
