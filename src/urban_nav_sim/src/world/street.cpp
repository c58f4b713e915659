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

constexpr double kHalfStreet = 5.6;  // half the width between the kerbs, m
constexpr double kPavement = 2.4;    // width
constexpr double kFace = kHalfStreet + kPavement;
constexpr double kSide = 4.4, kSideFace = kSide + kPavement;  // the same of side streets, half widths
constexpr int kBlocks = 5;
constexpr double kDepth = 9.0;  // of a house

/// Two long streets (y = 0 and y = second) and the side streets between, determined by the seed.
struct StreetPlan {
  double house, block, second;
  int houses;

  explicit StreetPlan(std::uint32_t seed) {
    Draw draw(hash(seed, 0x57E));
    house = draw.uniform(5.2, 6.0), houses = 9;
    block = house * houses + 2.0 * kSideFace;
    second = 2.0 * kFace + 2.0 * kDepth + draw.uniform(7, 12);
  }
  double sideStreet(int i) const { return block * i; }  ///< x of its centre line; the route begins at 0
  double first(int i) const { return sideStreet(i) + kSideFace; }
};

/// Builds a terrace: similar houses of a few kinds in a row, so that places are ambiguous.
void buildTerrace(Site& site, const StreetPlan& p, double x0, double y0, bool faces_south, std::uint64_t row,
                  std::uint32_t seed) {
  Draw draw(hash(seed, row, 0x7E2));
  Style kinds[3];
  for (int i = 0; i < 3; ++i) {
    Draw kind(hash(seed, static_cast<std::uint64_t>(i), 0x51D));
    Style& s = kinds[i];
    s.wall.stuff = i == 0 ? MaterialKind::Brick : i == 1 ? MaterialKind::Render : MaterialKind::DarkBrick;
    s.wall.variant = static_cast<std::uint64_t>(kind.index(3));
    s.roof.stuff = i == 2 ? MaterialKind::RoofTile : MaterialKind::Slate;
    s.window = i == 1 ? MaterialKind::Casement : MaterialKind::Sash;
    s.storeys = i == 2 ? 3 : 2, s.storey = kind.uniform(2.9, 3.2), s.sill = 0.8,
    s.window_height = kind.uniform(1.4, 1.6), s.window_width = kind.uniform(0.95, 1.15);
    s.spacing = 2.2, s.irregular = 0.0,
    s.seed = hash(seed, 0x111, static_cast<std::uint64_t>(i));  // the same for each house of the kind
    s.doors = {2, 0, 2, 0}, s.windows = {true, false, true, false};
  }
  for (int i = 0; i < p.houses; ++i) {
    Style s = kinds[draw.chance(0.75) ? static_cast<int>(row % 3) : draw.index(3)];
    s.wall.seed = static_cast<std::uint32_t>(draw.index(5000)), s.roof.seed = s.wall.seed % 7;
    s.door.variant = static_cast<std::uint64_t>(draw.index(5));
    if (i == 0) s.windows[3] = true;
    if (i + 1 == p.houses) s.windows[1] = true;
    if (faces_south) s.doors[2] = 0;
    if (!faces_south) s.doors[0] = 0;
    const double x = x0 + i * p.house;
    buildHouse(site, {x, y0, x + p.house, y0 + kDepth}, s);
  }
}

void addPavement(Site& site, const Extent& e) {
  const Finish slabs{MaterialKind::Slabs, 0, 3}, kerb{MaterialKind::Kerb, 0, 3};
  const double h = 0.5 * kPavement, height = 0.11;
  layStrip(site, slabs, kerb, {e.x0, e.y0 + h}, {e.x1, e.y0 + h}, kPavement, height);
  layStrip(site, slabs, kerb, {e.x0, e.y1 - h}, {e.x1, e.y1 - h}, kPavement, height);
  layStrip(site, slabs, kerb, {e.x0 + h, e.y0 + kPavement}, {e.x0 + h, e.y1 - kPavement}, kPavement, height);
  layStrip(site, slabs, kerb, {e.x1 - h, e.y0 + kPavement}, {e.x1 - h, e.y1 - kPavement}, kPavement, height);
}

void buildBlocks(Site& site, const StreetPlan& p, std::uint32_t seed) {
  Draw draw(hash(seed, 0xB10));
  for (int b = -1; b <= kBlocks; ++b) {
    const double x0 = p.first(b), x1 = x0 + p.house * p.houses;
    const auto row = static_cast<std::uint64_t>(b + 1);
    buildTerrace(site, p, x0, -kFace - kDepth, false, 4 * row, seed);
    buildTerrace(site, p, x0, kFace, true, 4 * row + 1, seed);
    buildTerrace(site, p, x0, p.second - kFace - kDepth, false, 4 * row + 2, seed);
    buildTerrace(site, p, x0, p.second + kFace, true, 4 * row + 3, seed);
    addPavement(site, {x0 - kPavement, -kFace - kDepth - kPavement, x1 + kPavement, -kHalfStreet});
    addPavement(site, {x0 - kPavement, kHalfStreet, x1 + kPavement, p.second - kHalfStreet});
    addPavement(site, {x0 - kPavement, p.second + kHalfStreet, x1 + kPavement, p.second + kFace + kDepth + kPavement});
    // Yards at the rear of the houses, with walls, hedges and a tree.
    const double y0 = kFace + kDepth, y1 = p.second - kFace - kDepth;
    for (const double x : {x0 + 0.2, x1 - 0.2})
      layStrip(site, {MaterialKind::Kerb, 1, 1}, {MaterialKind::Brick, 1, static_cast<std::uint32_t>(b + 5)}, {x, y0},
               {x, y1}, 0.25, 2.0);
    plantTree(site, x0 + draw.uniform(5, 40), 0.5 * (y0 + y1), draw.uniform(7, 11), draw.bits());
    plantTree(site, x1 - draw.uniform(1.6, 3.0), 0.5 * (y0 + y1), draw.uniform(6, 8), draw.bits());
    for (const double y :
         {-kHalfStreet - 0.5, kHalfStreet + 0.5, p.second - kHalfStreet - 0.5, p.second + kHalfStreet + 0.5}) {
      const bool south = y < 0.5 * p.second ? y < 0 : y < p.second;
      for (double x = x0 + draw.uniform(4, 10); x < x1 - 3; x += draw.uniform(16, 26))
        placeLamp(site, x, y, south ? M_PI / 2 : -M_PI / 2);
      if (draw.chance(0.7)) placeBin(site, x0 + draw.uniform(2, 40), y);
      if (draw.chance(0.6))
        plantTree(site, x0 + draw.uniform(10, 40), south ? y - 0.3 : y + 0.3, draw.uniform(5, 7), draw.bits());
      // Hedges in front of some houses.
      const double h = south ? y - 1.5 : y + 1.5, from = x0 + p.house * draw.index(p.houses - 2) + 2.6;
      if (draw.chance(0.8))
        plantHedge(site, {from, h}, {from + 2.2, h}, 0.5, draw.uniform(0.6, 1.1),
                   draw.chance(0.5) ? MaterialKind::Hedge : MaterialKind::Flowers, draw.bits());
    }
  }
}

void paintRoads(Site& site, const StreetPlan& p) {
  const Finish paint{MaterialKind::RoadPaint, 0, 2};
  const double above = 0.0015, x0 = p.sideStreet(-1), x1 = p.sideStreet(kBlocks + 1);
  for (const double y : {0.0, p.second}) {
    for (double x = x0; x < x1; x += 5.0) {
      if (std::abs(std::remainder(x + 1.0, p.block)) > kSideFace + 1.0)
        layStrip(site, paint, paint, {x, y}, {x + 2.0, y}, 0.12, above);
    }
    for (int b = -1; b <= kBlocks; ++b) {
      for (const double s : {-1.0, 1.0})
        layStrip(site, paint, paint, {p.first(b), y + s * (kHalfStreet - 0.25)},
                 {p.first(b) + p.house * p.houses, y + s * (kHalfStreet - 0.25)}, 0.09, above);
      // A crossing at the end of each block.
      for (int k = 0; k < 9; ++k)
        layStrip(site, paint, paint, {p.first(b) + 0.5, y - 4.4 + 1.1 * k}, {p.first(b) + 2.7, y - 4.4 + 1.1 * k}, 0.55,
                 above);
    }
  }
  for (int b = 0; b <= kBlocks; ++b) {
    for (double y = kFace; y < p.second - kFace; y += 4.0)
      layStrip(site, paint, paint, {p.sideStreet(b), y}, {p.sideStreet(b), y + 1.6}, 0.12, above);
  }
}

void fillStreetDay(Site& site, const StreetPlan& p, std::uint32_t seed, int day) {
  Draw draw(hash(seed, 0xDA9, static_cast<std::uint64_t>(day)));
  for (int b = 0; b < kBlocks; ++b) {
    for (const double y : {kHalfStreet - 1.25, p.second + kHalfStreet - 1.25, p.second - kHalfStreet + 1.25}) {
      for (double x = p.first(b) + 6; x < p.first(b) + p.house * p.houses - 3; x += draw.uniform(5.0, 6.5)) {
        if (draw.chance(0.35)) continue;
        parkCar(site, x, y + 0.08 * draw.normal(), draw.chance(0.8) ? 0.0 : M_PI, draw.chance(0.2), draw.bits());
      }
    }
  }
  const int people = day == 1 ? 4 : 8 + draw.index(6);
  for (int i = 0; i < people; ++i) {
    const double y = draw.chance(0.5) ? kHalfStreet + 1.3 : -kHalfStreet - 1.3, x = p.first(draw.index(3));
    sendWalker(site, {{x, y}, {x + p.house * p.houses, y}}, draw.uniform(1.0, 1.6), draw.uniform(), draw.bits());
  }
  // The robot turns off only to the north, and the ends are inside houses.
  const Vector2d east(p.sideStreet(kBlocks + 1) - 3.0, -3.2), west(p.sideStreet(-1) + 2.5, -3.2);
  sendTraffic(site, east, west, draw.uniform(5, 8), day == 1 ? 2 : 4, draw);
}

}  // namespace

World buildStreet(std::uint32_t seed, int day) {
  World world;
  world.name = "street", world.day = makeDay(seed, day), world.ground = makeGround(seed, 0.1);
  const StreetPlan p(seed);
  Site site(world, seed);
  const Extent all{p.sideStreet(-1) - 2, -kFace - kDepth - 8, p.sideStreet(kBlocks + 1) + 2,
                   p.second + kFace + kDepth + 8};
  const auto yard = [&](double x, double y) {
    const double off = std::abs(std::remainder(x - 0.5 * p.block, p.block));
    return std::min(0.5 * p.house * p.houses - off, std::min(y - kFace - 1.0, p.second - kFace - 1.0 - y));
  };
  const auto path = [&](double x, double y) { return std::min(yard(x, y), 0.8 - std::abs(y - 0.5 * p.second)); };
  const auto on_road = [&](std::uint64_t which) {
    return patches({all.x0, -kHalfStreet + 0.5, all.x1, kHalfStreet - 2.5}, 60, hash(seed, which));
  };
  layGround(site, all,
            {{{MaterialKind::Soil, 0, 1}, path},
             {{MaterialKind::Lawn, 0, 1}, yard},
             {{MaterialKind::Asphalt, 1, 4}, on_road(1)},
             {{MaterialKind::Asphalt, 2, 5}, on_road(2)},
             {{MaterialKind::Asphalt, 0, 1}, nullptr}});
  laySurroundings(site, all, 80.0, {MaterialKind::Meadow, 1, 2});
  buildBlocks(site, p, seed);
  paintRoads(site, p);
  // Closes the long streets at their ends.
  Style end;
  end.wall = {MaterialKind::Ashlar, 1, 3}, end.storeys = 3, end.seed = seed, end.doors = {0, 4, 0, 4};
  buildHouse(site, {p.sideStreet(-1) - 2, -9, p.sideStreet(-1) + 7, 9}, end);
  buildHouse(site, {p.sideStreet(kBlocks + 1) - 7, -9, p.sideStreet(kBlocks + 1) + 2, 9}, end);
  // Closes the side streets.
  for (int b = -1; b <= kBlocks + 1; ++b) {
    end.seed = hash(seed, static_cast<std::uint64_t>(b + 9)),
    end.wall = {b % 2 == 0 ? MaterialKind::Render : MaterialKind::Rubble, 2, static_cast<std::uint32_t>(b + 40)},
    end.doors = {3, 0, 3, 0};
    buildHouse(site, {p.sideStreet(b) - 7, -kFace - kDepth - 24, p.sideStreet(b) + 7, -kFace - kDepth - 14}, end);
    buildHouse(
        site,
        {p.sideStreet(b) - 7, p.second + kFace + kDepth + 14, p.sideStreet(b) + 7, p.second + kFace + kDepth + 24},
        end);
  }
  fillStreetDay(site, p, seed, day);
  return world;
}

std::vector<Route> routesOfStreet(std::uint32_t seed) {
  const StreetPlan p(seed);
  const double x1 = p.sideStreet(1), y1 = p.second;
  const std::vector<Vector2d> round = {{0, 0}, {x1, 0}, {x1, y1}, {0, y1}};
  std::vector<Vector2d> loops = round, orbits4;
  // Around a block, along the first street again, back, and around the next block.
  for (const Vector2d& v : {Vector2d(0, 0), Vector2d(x1 - 20, 0), Vector2d(0, 0), Vector2d(p.sideStreet(2), 0),
                            Vector2d(p.sideStreet(2), y1), Vector2d(0, y1), Vector2d(0, 0)})
    loops.push_back(v);
  for (int i = 0; i < 4; ++i) orbits4.insert(orbits4.end(), round.begin(), round.end());
  orbits4.push_back({0, 0});
  return {{"loops", "round a block, along its front again and back, then round two blocks", through(loops)},
          {"orbits4", "four times round a block", through(orbits4)},
          {"reversed", "loops from its end to its start", backwards(through(loops))},
          {"straight300", "300 m along the first street", through({{0, 0}, {100, 0}, {200, 0}, {300, 0}})}};
}

}  // namespace urban_nav_sim
