// SPDX-License-Identifier: BSD-3-Clause
#include "world/building.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace urban_nav_sim {
namespace {

using Eigen::Vector3f;

TEST(Building, AWallHasHolesAtItsOpeningsAndFacesOutwards) {
  World world;
  world.ground = [](double, double) { return 0.0; };
  Site site(world, 1);
  const Finish wall{MaterialKind::Brick, 0, 1}, trim{MaterialKind::Kerb, 0, 1}, window{MaterialKind::Sash, 0, 1};
  buildWall(site, wall, trim, {0, 0}, {1, 0}, 10.0, -1.0, 5.0,
            {{1, 2, 1, 2.5, 0.2, window}, {4, 5.5, 1, 2.5, 0.2, window}, {1, 2, 3, 4.5, 0.2, window}});
  double area = 0.0;
  const Part& part = site.part(wall);
  for (const auto& t : part.triangles) {
    const Vector3f a = part.vertices[t[0]], normal = (part.vertices[t[1]] - a).cross(part.vertices[t[2]] - a);
    EXPECT_LT(normal.y(), 0.0F);  // the right of +x
    area += 0.5 * static_cast<double>(normal.norm());
  }
  EXPECT_NEAR(area, 60.0 - 1.5 - 2.25 - 1.5, 1e-4);
  // Texture is in metres: distances along the surface are those in space.
  for (const auto& t : part.triangles) {
    EXPECT_NEAR((part.texture[t[1]] - part.texture[t[0]]).norm(), (part.vertices[t[1]] - part.vertices[t[0]]).norm(),
                1e-5F);
  }
  for (const Vector3f& v : site.part(window).vertices) EXPECT_NEAR(v.y(), 0.2F, 1e-6F);  // inside the wall
}

TEST(Building, AHouseFillsItsRectangleAndHasWindowsDoorsAndARoof) {
  World world;
  world.ground = [](double, double) { return 0.0; };
  Site site(world, 1);
  Style style;
  style.wall = {MaterialKind::Brick, 0, 5}, style.doors = {2, 0, 0, 0}, style.irregular = 0.0;
  buildHouse(site, {0, 0, 12, 8}, style);
  bool window = false, door = false, roof = false;
  for (const Part& part : world.parts) {
    const std::string& name = world.materials[part.material].name;
    window |= name == "window", door |= name == "door", roof |= name == "slate";
    for (const Vector3f& v : part.vertices) {
      EXPECT_GT(v.x(), -0.5F);
      EXPECT_LT(v.x(), 12.5F);
      EXPECT_GT(v.y(), -0.5F);
      EXPECT_LT(v.y(), 8.5F);
    }
  }
  EXPECT_TRUE(window && door && roof);
}

}  // namespace
}  // namespace urban_nav_sim
