// SPDX-License-Identifier: BSD-3-Clause
#include "camera/edges.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "camera/render.hpp"
#include "ray_tracing/small_worlds.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector3d;
using urban_nav_core::Pose;

constexpr double kHeight = 8.0, kFocal = 400.0;  // m above the ground, px: 20 mm a pixel

// The ground from above, of one colour, x to the right and y upwards in the image.
Picture fromAbove(World& world) {
  for (Material& material : world.materials) {
    material.detail = nullptr;
    material.layers = {};
  }
  world.day.to_sun = Eigen::Vector3f(-1.0F, 0.0F, 1.0F).normalized();
  world.parts.push_back(quad(kGround, {-30, -30, 0}, {60, 0, 0}, {0, 60, 0}));
  Eigen::Matrix3d down;
  down << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  const Lens lens{200, 200, kFocal, kFocal, 99.5, 99.5, {}};
  const Tracer tracer(world);
  Picture picture;
  render(Snapshot(tracer, 0, 0), Sky(world.day, 1), RayTable(lens), Pose(down, Vector3d(0.0, 0.0, kHeight)),
         Colours::Grey, picture);
  return picture;
}

// Where along each row the dark part begins, from the sum of its light: as far as 1/8 px of a pixel may be off.
void expectEdge(const Picture& picture, double (*x_at)(double y), double per_pixel, double worst_mean) {
  const float dark = picture.radiance[picture.at(190, 100)], light = picture.radiance[picture.at(10, 100)];
  ASSERT_GT(light, 1.2F * dark);
  double sum = 0.0;
  int rows = 0;
  for (int v = 60; v < 140; ++v, ++rows) {
    double lit = 0.0;
    for (int u = 0; u < 200; ++u)
      lit += static_cast<double>((picture.radiance[picture.at(u, v)] - dark) / (light - dark));
    const double y = -(v - 99.5) * kHeight / kFocal, expected = x_at(y) * kFocal / kHeight + 99.5 + 0.5;
    EXPECT_NEAR(lit, expected, per_pixel) << v;
    sum += lit - expected;
  }
  EXPECT_NEAR(sum / rows, 0.0, worst_mean);
}

TEST(Edges, OfASurfaceAreAccurateToAFractionOfAPixel) {
  World world = emptyWorld();
  // A sheet on the ground, hardly above it: its left edge leans by one in ten.
  Part sheet = quad(kWall, {0.0F, -4.0F, 1e-4F}, {10, 0, 0}, {0.8F, 8, 0});
  world.materials[kWall].colours[0] = world.materials[kWall].colours[1] = Eigen::Vector3f::Constant(0.05F);
  world.materials[kGround].colours[0] = world.materials[kGround].colours[1] = Eigen::Vector3f::Constant(0.6F);
  world.parts.push_back(sheet);
  expectEdge(
      fromAbove(world), [](double y) { return 0.1 * (y + 4.0); }, 0.26, 0.02);
}

TEST(Edges, OfAShadowToo) {
  constexpr double kOffTheGround = 0.002;  // m: from there rays go to the sun, which is 45 degrees up
  World world = emptyWorld();
  // A screen high above the camera, in the sun's way; its shadow begins 20 m further to the right, and leans as it
  // does.
  world.parts.push_back(quad(kWall, {-20.0F, -4.0F, 20.0F}, {10, 0, 0}, {0.8F, 8, 0}));
  expectEdge(
      fromAbove(world), [](double y) { return 0.1 * (y + 4.0) - kOffTheGround; }, 0.26, 0.02);
}

}  // namespace
}  // namespace urban_nav_sim
