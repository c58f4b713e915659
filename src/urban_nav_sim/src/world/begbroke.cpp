// SPDX-License-Identifier: BSD-3-Clause
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

constexpr double kHalfRoad = 3.4;  // half the width of a road, m

/// A science park: a C-shaped building with a ring road, car parks, other buildings, a triangular lawn.
struct BegbrokePlan {
  double width, depth;  ///< of the centre line of the ring road, whose south side passes through the origin
  std::vector<Vector2d> ring, footpath;

  explicit BegbrokePlan(std::uint32_t seed) {
    Draw draw(hash(seed, 0xBE6));
    width = draw.uniform(56, 64), depth = draw.uniform(42, 50);
    const double w = 0.5 * width;
    ring = {{0, 0}, {w, 0}, {w, depth}, {-w, depth}, {-w, 0}, {0, 0}};
    footpath = rounded({{w, 0}, {w + 18, -6}, {w + 34, 4}, {w + 40, 20}, {w + 30, 38}, {w + 12, depth - 4}, {w, depth}},
                       false);
  }
  double half() const { return 0.5 * width; }
  Extent carPark() const { return {-half() - 30, 2, -half() - kHalfRoad + 0.5, depth - 4}; }
  Extent southPark() const { return {-half(), -26, half() - 8, -kHalfRoad + 0.5}; }
};

void buildPark(Site& site, const BegbrokePlan& p, std::uint32_t seed) {
  Draw draw(hash(seed, 0xB17));
  Style s;
  s.pitch = 0.45, s.storeys = 2, s.storey = 3.3, s.window = MaterialKind::ShopWindow, s.window_width = 1.8,
  s.window_height = 1.5, s.spacing = 3.0;
  s.roof.stuff = MaterialKind::RoofTile, s.irregular = 0.18;
  const auto house = [&](const Extent& e, MaterialKind wall, std::uint64_t variant) {
    s.seed = draw.bits(), s.wall = {wall, variant, static_cast<std::uint32_t>(draw.index(4000))};
    s.door.variant = variant;
    buildHouse(site, e, s);
  };
  const double x0 = -p.half() + 8.5, x1 = p.half() - 8.5, y0 = 8.5, y1 = p.depth - 8.5;
  s.doors = {6, 5, 6, 4};
  house({x0, y0, x1, y0 + 9}, MaterialKind::Brick, 0);
  house({x0, y1 - 9, x1, y1}, MaterialKind::Brick, 0);
  house({x0, y0 + 9, x0 + 10, y1 - 9}, MaterialKind::Render, 1);
  s.pitch = 0.0, s.window = MaterialKind::Casement, s.window_width = 1.2;
  house({p.half() + 9, p.depth + 8, p.half() + 34, p.depth + 20}, MaterialKind::Render, 2);
  house({-p.half() + 2, p.depth + 9, -2, p.depth + 22}, MaterialKind::Brick, 2);
  s.pitch = 0.7, s.storeys = 3;
  house({4, p.depth + 8, p.half() - 2, p.depth + 19}, MaterialKind::Rubble, 1);
  s.storeys = 2;
  house({-p.half() - 46, 6, -p.half() - 34, p.depth - 6}, MaterialKind::DarkBrick, 1);
  house({-p.half() + 4, -42, 6, -31}, MaterialKind::Render, 3);
  house({p.half() - 2, -34, p.half() + 22, -22}, MaterialKind::Brick, 1);
  house({p.half() + 50, 2, p.half() + 62, 34}, MaterialKind::Render, 0);
}

void plantPark(Site& site, const BegbrokePlan& p, std::uint32_t seed) {
  Draw draw(hash(seed, 0x97A));
  const double w = p.half();
  // Between the ring road and the buildings, and in the yard of the C.
  for (double x = -w + 10; x < w - 12; x += draw.uniform(6, 10)) {
    for (const double y : {6.9, p.depth - 6.9}) {
      if (draw.chance(0.6))
        plantHedge(site, {x, y}, {x + draw.uniform(1, 5), y}, 0.8, draw.uniform(0.5, 1.2),
                   draw.chance(0.3) ? MaterialKind::Flowers : MaterialKind::Shrub, draw.bits());
    }
  }
  for (int i = 0; i < 3; ++i)
    plantTree(site, w - 16 - 5.0 * i, 0.5 * p.depth + draw.uniform(-3, 3), draw.uniform(6, 9), draw.bits());
  for (double y = 4; y < p.depth; y += 15)
    placeLamp(site, -w + kHalfRoad + 1.2, y, M_PI), placeLamp(site, w - kHalfRoad - 1.2, y, 0.0);
  for (double x = -w + 5; x < w - 4; x += 17)
    placeLamp(site, x, kHalfRoad + 1.2, -M_PI / 2), placeLamp(site, x, p.depth + kHalfRoad + 1.2, -M_PI / 2);
  std::vector<Vector2d> ways = p.footpath;
  for (int i = 0, planted = 0; i < 400 && planted < 26; ++i) {  // the wedge of grass in the east
    const double x = draw.uniform(w + 7, w + 48), y = draw.uniform(-18, p.depth + 4), height = draw.uniform(5, 11);
    if (distanceTo(ways, x, y) < 2.4 + 0.1 * height) continue;
    if (draw.chance(0.6)) plantTree(site, x, y, height, draw.bits());
    else
      plantHedge(site, {x, y}, {x + 0.7, y + draw.uniform(0.5, 0.9)}, draw.uniform(0.8, 1.5), draw.uniform(0.7, 1.5),
                 MaterialKind::Shrub, draw.bits());
    ++planted;
  }
  const Extent park = p.carPark(), south = p.southPark();
  plantHedge(site, {park.x0 - 1.2, park.y0}, {park.x0 - 1.2, park.y1}, 1.0, 1.3, MaterialKind::Hedge, draw.bits());
  plantHedge(site, {south.x0, south.y0 - 1.2}, {south.x1, south.y0 - 1.2}, 1.0, 1.5, MaterialKind::Hedge, draw.bits());
  for (const double x : {-w - 2.5, -w + 26.0}) plantTree(site, x, p.depth + 6.5, draw.uniform(5, 7), draw.bits());
  placeBench(site, w + 30, 8.5, 0.6), placeBench(site, w + 32, 28.0, 2.4), placeBin(site, w + 7, -4.8);
}

void paintBays(Site& site, const BegbrokePlan& p) {
  const Finish paint{MaterialKind::RoadPaint, 0, 2}, kerb{MaterialKind::Kerb, 0, 1};
  const double above = 0.0015;
  const Extent a = p.carPark(), b = p.southPark();
  for (double y = a.y0 + 1; y < a.y1; y += 2.6) {
    for (const double x : {a.x0 + 2.7, a.x0 + 14.0})
      layStrip(site, paint, paint, {x - 2.4, y}, {x + 2.4, y}, 0.1, above);
  }
  for (double x = b.x0 + 3; x < b.x1 - 1; x += 2.6)
    layStrip(site, paint, paint, {x, b.y0 + 0.4}, {x, b.y0 + 5.2}, 0.1, above),
        layStrip(site, paint, paint, {x, b.y0 + 11.4}, {x, b.y0 + 16.2}, 0.1, above);
  const double w = p.half();
  for (const double x : {-w, w}) {
    for (double y = 4; y < p.depth - 4; y += 4) layStrip(site, paint, paint, {x, y}, {x, y + 1.5}, 0.1, above);
  }
  for (const double y : {0.0, p.depth}) {
    for (double x = -w + 4; x < w - 5; x += 4) layStrip(site, paint, paint, {x, y}, {x + 1.5, y}, 0.1, above);
  }
  const double in = kHalfRoad + 0.08;
  for (const auto& [from, to] : {std::pair<Vector2d, Vector2d>{{-w + in, in}, {w - in, in}},
                                 {{w - in, in}, {w - in, p.depth - in}},
                                 {{w - in, p.depth - in}, {-w + in, p.depth - in}},
                                 {{-w + in, p.depth - in}, {-w + in, in}}}) {
    layStrip(site, kerb, kerb, from, to, 0.15, 0.1);
  }
}

void fillBegbrokeDay(Site& site, const BegbrokePlan& p, std::uint32_t seed, int day) {
  Draw draw(hash(seed, 0xDA7, static_cast<std::uint64_t>(day)));
  const Extent a = p.carPark(), b = p.southPark();
  for (double y = a.y0 + 2.3; y < a.y1 - 1.5; y += 2.6) {
    for (const double x : {a.x0 + 2.7, a.x0 + 14.0}) {
      if (draw.chance(0.7))
        parkCar(site, x + 0.15 * draw.normal(), y, draw.chance(0.5) ? 0.0 : M_PI, draw.chance(0.15), draw.bits());
    }
  }
  for (double x = b.x0 + 4.3; x < b.x1 - 2; x += 2.6) {
    for (const double y : {b.y0 + 2.8, b.y0 + 13.8}) {
      if (draw.chance(0.65))
        parkCar(site, x, y + 0.15 * draw.normal(), draw.chance(0.5) ? M_PI / 2 : -M_PI / 2, draw.chance(0.15),
                draw.bits());
    }
  }
  const int people = day == 1 ? 3 : 6 + draw.index(5);
  for (int i = 0; i < people; ++i) {
    const double w = p.half(), y = draw.chance(0.5) ? kHalfRoad + 2.0 : p.depth - kHalfRoad - 2.0;
    sendWalker(site, {{-w + 8, y}, {w - 8, y}}, draw.uniform(1.0, 1.6), draw.uniform(), draw.bits());
  }
  if (day > 1) sendCar(site, {a.x0 + 8.3, a.y0}, {a.x0 + 8.3, a.y1}, draw.uniform(2, 4), draw.uniform(), draw.bits());
}

}  // namespace

World buildBegbroke(std::uint32_t seed, int day) {
  World world;
  world.name = "begbroke", world.day = makeDay(seed, day), world.ground = makeGround(seed, 0.13);
  const BegbrokePlan p(seed);
  Site site(world, seed);
  const double w = p.half();
  const Extent all{-w - 52, -48, w + 66, p.depth + 28}, park = p.carPark(), south = p.southPark();
  const auto strewn = patches({-w - 3, -3, w + 3, p.depth + 3}, 120, seed);
  const auto mended = [&](double x, double y) {
    return std::min(strewn(x, y), kHalfRoad - 0.4 - distanceTo(p.ring, x, y));
  };
  layGround(site, all,
            {{{MaterialKind::Asphalt, 2, 5}, mended},
             {{MaterialKind::Asphalt, 0, 1}, [&](double x, double y) { return kHalfRoad - distanceTo(p.ring, x, y); }},
             {{MaterialKind::Asphalt, 1, 2}, [&](double x, double y) { return insideRectangle(park, 1.0, x, y); }},
             {{MaterialKind::Asphalt, 1, 2}, [&](double x, double y) { return insideRectangle(south, 1.0, x, y); }},
             {{MaterialKind::Soil, 0, 1}, [&](double x, double y) { return 1.3 - distanceTo(p.footpath, x, y); }},
             {{MaterialKind::Slabs, 0, 1},
              [&](double x, double y) {
                return insideRectangle({-w + 6.9, 6.9, w - 6.9, p.depth - 6.9}, 0.3, x, y);
              }},
             {{MaterialKind::Lawn, 0, 1},
              [&](double x, double y) {
                return insideRectangle({-w, 0, w, p.depth}, 0.0, x, y);
              }},
             {{MaterialKind::Meadow, 0, 1}, nullptr}});
  laySurroundings(site, all, 80.0, {MaterialKind::Meadow, 1, 2});
  buildPark(site, p, seed);
  plantPark(site, p, seed);
  const double x0 = all.x0 + 2, x1 = all.x1 - 2, y0 = all.y0 + 2, y1 = all.y1 - 3;
  plantBelt(site, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}}, seed);
  paintBays(site, p);
  fillBegbrokeDay(site, p, seed, day);
  return world;
}

std::vector<Route> routesOfBegbroke(std::uint32_t seed) {
  const BegbrokePlan p(seed);
  const double w = p.half(), d = p.depth;
  const std::vector<Vector2d> round = {{0, 0}, {w, 0}, {w, d}, {-w, d}, {-w, 0}};
  std::vector<Vector2d> loops = round, orbits4;
  // Around the building, to the corner, back, then through the grass in the east and home along the north side.
  for (const Vector2d& v : {Vector2d(0, 0), Vector2d(w, 0), Vector2d(0, 0)}) loops.push_back(v);
  loops.insert(loops.end(), p.footpath.begin(), p.footpath.end());
  for (const Vector2d& v : {Vector2d(-w, d), Vector2d(-w, 0), Vector2d(0, 0)}) loops.push_back(v);
  for (int i = 0; i < 4; ++i) orbits4.insert(orbits4.end(), round.begin(), round.end());
  orbits4.push_back({0, 0});
  return {{"loops", "round the building, to its corner and back, then through the grass and home", through(loops)},
          {"orbits4", "four times round the building", through(orbits4)},
          {"reversed", "loops from its end to its start", backwards(through(loops))}};
}

}  // namespace urban_nav_sim
