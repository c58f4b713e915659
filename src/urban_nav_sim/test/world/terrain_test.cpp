// SPDX-License-Identifier: BSD-3-Clause
#include "world/terrain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace urban_nav_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

double computeArea(const Part& part) {
  double area = 0.0;
  for (const auto& t : part.triangles) {
    const Vector3f a = part.vertices[t[0]], b = part.vertices[t[1]], c = part.vertices[t[2]];
    const float up = (b - a).cross(c - a).z();
    EXPECT_GE(up, -1e-6F);  // seen from above
    area += 0.5 * static_cast<double>(up);
  }
  return area;
}

World flatWorld() {
  World world;
  world.ground = [](double, double) { return 0.0; };
  return world;
}

TEST(Terrain, RegionsFillTheGroundWithoutGapsAndWithTheirOwnSize) {
  World world = flatWorld();
  Site site(world, 1);
  const Finish disc{MaterialKind::Lawn, 0, 1}, square{MaterialKind::Slabs, 0, 1}, rest{MaterialKind::Meadow, 0, 1};
  layGround(site, {-10, -10, 10, 10},
            {{disc, [](double x, double y) { return 4.0 - std::hypot(x, y); }},
             {square,
              [](double x, double y) {
                return insideRectangle({0, 0, 6.1, 6.1}, 0.0, x, y);
              }},
             {rest, nullptr}});
  EXPECT_NEAR(computeArea(site.part(disc)), M_PI * 16.0, 0.3);
  EXPECT_NEAR(computeArea(site.part(square)), 6.1 * 6.1 - M_PI * 4.0, 0.4);
  EXPECT_NEAR(computeArea(site.part(disc)) + computeArea(site.part(square)) + computeArea(site.part(rest)), 400.0,
              0.01);
}

TEST(Terrain, EdgesOfRegionsAreCutNotStepped) {
  World world = flatWorld();
  Site site(world, 1);
  const Finish disc{MaterialKind::Lawn, 0, 1};
  layGround(
      site, {-6, -6, 6, 6},
      {{disc, [](double x, double y) { return 4.0 - std::hypot(x, y); }}, {{MaterialKind::Meadow, 0, 1}, nullptr}});
  float farthest = 0.0F;
  for (const Vector3f& v : site.part(disc).vertices) farthest = std::max(farthest, v.head<2>().norm());
  EXPECT_NEAR(farthest, 4.0F, 0.01F);
}

TEST(Terrain, AStripIsAsWideAndHighAsWanted) {
  World world = flatWorld();
  Site site(world, 1);
  const Finish top{MaterialKind::Slabs, 0, 1}, side{MaterialKind::Kerb, 0, 1};
  layStrip(site, top, side, {1, 2}, {11, 2}, 1.5, 0.11);
  EXPECT_NEAR(computeArea(site.part(top)), 15.0, 1e-3);
  for (const Vector3f& v : site.part(top).vertices) EXPECT_NEAR(v.z(), 0.11F, 1e-6F);
}

TEST(Terrain, DistancesAreThoseOfGeometry) {
  EXPECT_NEAR(distanceTo({{0, 0}, {10, 0}}, 5, 3), 3.0, 1e-12);
  EXPECT_NEAR(distanceTo({{0, 0}, {10, 0}}, 13, 4), 5.0, 1e-12);
  EXPECT_NEAR(insideRectangle({0, 0, 4, 2}, 0.0, 1, 1), 1.0, 1e-12);
  EXPECT_LT(insideRectangle({0, 0, 4, 2}, 1.0, 0.1, 0.1), 0.0);
  EXPECT_GT(insideRectangle({0, 0, 4, 2}, 0.0, 0.1, 0.1), 0.0);
}

TEST(Terrain, GroundDependsOnItsSeedAlone) {
  EXPECT_EQ(makeGround(3, 0.1)(12, -7), makeGround(3, 0.1)(12, -7));
  EXPECT_NE(makeGround(3, 0.1)(12, -7), makeGround(4, 0.1)(12, -7));
  EXPECT_EQ(makeGround(3, 0.1)(0, 0), 0.0);
}

}  // namespace
}  // namespace urban_nav_sim
