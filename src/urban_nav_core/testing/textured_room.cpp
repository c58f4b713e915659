// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/textured_room.hpp"

#include <cassert>
#include <random>

namespace urban_nav_core::testing {
namespace {

std::shared_ptr<const Texture> wallpaper(double base, std::uint32_t seed) {
  return std::make_shared<Texture>(
      base, std::vector<Octave>{{1.1, 12.0, false}, {0.3, 7.0, false}, {0.08, 9.0, true}, {0.022, 12.0, true}},
      std::vector<Cells>{{1.70, 1.45, 0.35, 0.28, 0.24, 0.60, -75.0, 65.0, 1},  // posters
                         {0.31, 0.27, 0.40, 0.05, 0.04, 0.30, -45.0, 45.0, 2},  // and what is printed on them
                         {0.085, 0.11, 0.30, 0.012, 0.02, 0.16, -40.0, 40.0, 3}},
      seed);
}

std::shared_ptr<const Texture> bricks(std::uint32_t seed) {
  return std::make_shared<Texture>(
      165.0, std::vector<Octave>{{1.2, 11.0, false}, {0.25, 6.0, false}, {0.06, 8.0, true}, {0.018, 10.0, true}},
      std::vector<Cells>{{0.42, 0.16, 0.5, 0.009, 0.008, 1.0, -75.0, -15.0, 4},
                         {2.4, 1.9, 0.0, 0.7, 0.5, 0.5, -50.0, 60.0, 5}},
      seed);
}

std::shared_ptr<const Texture> tiles(double base, std::uint32_t seed) {
  return std::make_shared<Texture>(base,
                                   std::vector<Octave>{{0.9, 10.0, false}, {0.12, 11.0, true}, {0.025, 13.0, true}},
                                   std::vector<Cells>{{0.62, 0.62, 0.0, 0.008, 0.008, 1.0, -22.0, 18.0, 6},
                                                      {0.31, 0.31, 0.5, 0.06, 0.06, 0.13, -50.0, 40.0, 7}},
                                   seed);
}

std::shared_ptr<const Texture> crate(std::uint32_t seed) {
  return std::make_shared<Texture>(
      120.0, std::vector<Octave>{{0.5, 15.0, false}, {0.15, 12.0, false}, {0.045, 11.0, true}, {0.015, 10.0, true}},
      std::vector<Cells>{{0.27, 0.21, 0.3, 0.03, 0.03, 0.55, -50.0, 60.0, 8},
                         {0.06, 0.075, 0.5, 0.008, 0.012, 0.2, -40.0, 40.0, 9}},
      seed);
}

Rectangle wall(const Vector3d& corner, const Vector3d& a, const Vector3d& b, double size_a, double size_b,
               std::shared_ptr<const Texture> texture, double shade) {
  return {corner, a, b, size_a, size_b, std::move(texture), 0.0, 0.0, shade};
}

}  // namespace

Scene texturedRoom(const RoomSize& size, std::uint32_t seed) {
  assert(size.x >= 6.0 && size.y >= 4.0 && size.z >= 2.0);
  const double x = 0.5 * size.x, y = 0.5 * size.y, z = size.z;
  const Vector3d X = Vector3d::UnitX(), Y = Vector3d::UnitY(), Z = Vector3d::UnitZ();
  const std::uint32_t s = 100U * seed;
  Scene room;
  room.background = 0.0;
  room.rectangles = {wall({-x, -y, 0.0}, X, Y, size.x, size.y, tiles(105.0, s + 1), 1.0),
                     wall({-x, y, z}, X, -Y, size.x, size.y, tiles(175.0, s + 2), 0.95),
                     wall({x, y, 0.0}, -Y, Z, size.y, z, bricks(s + 3), 1.0),
                     wall({-x, -y, 0.0}, Y, Z, size.y, z, wallpaper(135.0, s + 4), 0.9),
                     wall({x, -y, 0.0}, -X, Z, size.x, z, wallpaper(120.0, s + 5), 0.85),
                     wall({-x, y, 0.0}, X, Z, size.x, z, wallpaper(150.0, s + 6), 1.0)};
  std::mt19937 random(seed);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  const auto texture = crate(s + 7);
  const auto put = [&](double px, double py, const Vector3d& box) {
    const Pose T_world_box(expSo3(Vector3d(0.0, 0.0, between(-0.4, 0.4))), Vector3d(px, py, 0.0));
    room.addBox(T_world_box, box, texture, between(0.0, 5.0));
  };
  // Along the walls, so that the middle stays free: RoomSize::freeX, freeY.
  const double edge_x = x - 0.75, edge_y = y - 0.7;
  put(edge_x, 0.55 * y, {0.6, 0.7, between(0.7, 1.1)});
  put(edge_x, -0.5 * y, {0.5, 0.6, between(1.2, 1.6)});
  put(-edge_x, -0.45 * y, {0.6, 0.8, between(0.8, 1.3)});
  put(-edge_x, 0.6 * y, {0.4, 0.4, size.z - 0.3});
  put(-0.3 * x, edge_y, {0.8, 0.5, between(0.6, 1.0)});
  put(0.45 * x, edge_y, {0.4, 0.4, between(1.5, 2.0)});
  put(0.1 * x, -edge_y, {0.9, 0.5, between(0.5, 0.9)});
  put(-0.6 * x, -edge_y, {0.5, 0.5, between(1.0, 1.8)});
  return room;
}

}  // namespace urban_nav_core::testing
