// SPDX-License-Identifier: BSD-3-Clause
#include "camera/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "camera/rig.hpp"
#include "camera/shade.hpp"
#include "laser/lms291.hpp"
#include "ray_tracing/small_worlds.hpp"
#include "rig/sensor_poses.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector3d;
using urban_nav_core::Pose;

struct RenderScene {
  World world = yard();
  Tracer tracer{world};
  Sky sky{world.day, 1};
  Pose T_world_left = sensorPose("stereo_left_optical_frame");
};

Picture rendered(const RenderScene& scene, const Lens& lens, const Pose& T_world_camera,
                 Colours colours = Colours::Grey, double t = 2.5) {
  Picture picture;
  render(Snapshot(scene.tracer, t, t), scene.sky, RayTable(lens), T_world_camera, colours, picture);
  return picture;
}

TEST(Render, DepthIsThatOfTheTrueSurfaceThroughEachLens) {
  const RenderScene scene;
  for (const auto images : {StereoImages::Raw, StereoImages::Rectified}) {
    for (const Camera& camera : bumblebee(images)) {
      const Pose T = scene.T_world_left * camera.T_head_camera;
      const Picture picture = rendered(scene, camera.lens, T);
      int count = 0;
      for (int v = 3; v < 384; v += 7) {
        for (int u = 3; u < 512; u += 7) {
          const auto depth = static_cast<double>(picture.depth[picture.at(u, v)]);
          const auto surface = picture.surface_class[picture.at(u, v)];
          if (!std::isfinite(depth) || surface == static_cast<int>(SurfaceClass::Foliage)) continue;
          const auto ideal = camera.lens.idealAt({u, v});
          const Vector3d p = T * Vector3d(depth * Vector3d(ideal->x(), ideal->y(), 1.0));
          const double to_slanted = std::abs(std::sin(0.35F) * (p.x() + 20) - std::cos(0.35F) * (p.y() - 4));
          EXPECT_LT(std::min({std::abs(p.z()), std::abs(p.x() - 6.0), std::abs(p.x() - 4.0), to_slanted}), 1e-4)
              << u << " " << v;
          ++count;
        }
      }
      EXPECT_GT(count, 1500);
    }
  }
}

TEST(Render, ABeamAndTheDepthImageMeetInOnePoint) {
  const RenderScene scene;
  const Lens lens = bumblebee(StereoImages::Rectified)[0].lens;
  const Pose T_laser(Eigen::Quaterniond::Identity(), Vector3d(0.1, 0.0600025, 1.1));
  const Lms291 laser(scene.tracer, T_laser, 1, "test", Lms291::Settings::exact());
  const auto scan = laser.scan(SteadyMotion(), 2.5, 0, 0);
  int compared = 0;
  for (int beam = 30; beam <= 150; beam += 3) {
    const auto range = static_cast<double>(scan.ranges[static_cast<std::size_t>(beam)]);
    const double angle = scan.angle_first + beam * scan.angle_step;
    const Vector3d p = T_laser * Vector3d(range * std::cos(angle), range * std::sin(angle), 0.0);
    const Vector3d p_cam = scene.T_world_left.inverse() * p;
    // A camera whose pixel (0, 0) is exactly there.
    Lens one = lens;
    one.width = one.height = 1;
    one.cx = -lens.fx * p_cam.x() / p_cam.z();
    one.cy = -lens.fy * p_cam.y() / p_cam.z();
    const Picture pixel = rendered(scene, one, scene.T_world_left);
    EXPECT_NEAR(static_cast<double>(pixel.depth[0]), p_cam.z(), 1e-4) << beam;
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

TEST(Render, SameBytesForAnyNumberOfThreads) {
  const RenderScene scene;
  const Lens lens = ladybug()[2].lens;
  std::vector<Picture> pictures;
  for (const int threads : {1, 2, 3}) {
    const urban_nav_core::ThreadLimit limit(threads);
    pictures.push_back(rendered(scene, lens, scene.T_world_left, Colours::Rgb));
  }
  for (std::size_t i : {1U, 2U}) {
    EXPECT_EQ(pictures[i].radiance, pictures[0].radiance);
    EXPECT_EQ(pictures[i].depth, pictures[0].depth);
    EXPECT_EQ(pictures[i].surface_class, pictures[0].surface_class);
  }
}

TEST(Render, ShadowsFallWhereTheyMust) {
  World world = emptyWorld();
  world.materials[kGround].detail = nullptr;  // of one colour
  world.materials[kGround].layers = {};
  world.day.to_sun = Eigen::Vector3f(-1.0F, 0.0F, 1.0F).normalized();
  world.parts.push_back(quad(kGround, {-30, -30, 0}, {60, 0, 0}, {0, 60, 0}));
  world.parts.push_back(
      quad(kWall, {2, 1, 1}, {0, -2, 0}, {0, 0, 1}));  // a screen that hovers: its shadow is x = 3 ... 4
  const Tracer tracer(world);
  const Sky sky(world.day, 1);
  Eigen::Matrix3d down;
  down << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  const Pose T_world_camera(down, Vector3d(4.0, 0.0, 8.0));
  const Lens lens{400, 400, 400.0, 400.0, 199.5, 199.5, {}};
  Picture picture;
  render(Snapshot(tracer, 0, 0), sky, RayTable(lens), T_world_camera, Colours::Grey, picture);
  const auto at = [&](double x, double y) {
    const auto pixel = lens.project(T_world_camera.inverse() * Vector3d(x, y, 0.0));
    return picture
        .radiance[picture.at(static_cast<int>(std::lround(pixel->x())), static_cast<int>(std::lround(pixel->y())))];
  };
  const float lit = at(5.0, 0.0), dark = at(3.5, 0.0);
  EXPECT_LT(dark, 0.6F * lit);
  for (double x = 2.65; x < 6.0; x += 0.1) {
    for (double y = -1.55; y < 1.6; y += 0.1) {
      const bool is_dark = x > 3.0 && x < 4.0 && std::abs(y) < 1.0;
      EXPECT_NEAR(at(x, y), is_dark ? dark : lit, 0.02F * lit) << x << " " << y;
    }
  }
}

TEST(Render, ClassesAreThoseOfTheMaterials) {
  const RenderScene scene;
  const Picture picture = rendered(scene, ladybug()[0].lens, scene.T_world_left);
  std::array<int, 8> count{};
  for (const std::uint8_t c : picture.surface_class) ++count[c];
  EXPECT_GT(count[static_cast<std::size_t>(SurfaceClass::Foliage)], 500);
  EXPECT_GT(count[static_cast<std::size_t>(scene.world.materials[kWall].surface_class)], 10000);
  EXPECT_GT(count[static_cast<std::size_t>(scene.world.materials[kGround].surface_class)], 10000);
}

TEST(Sky, IsBrightBlueAndTheSameAgain) {
  Day day;
  day.clouds = 0.0F;
  day.to_sun = Eigen::Vector3f(0.6F, 0.0F, 0.8F);
  const Sky sky(day, 3), again(day, 3);
  const Eigen::Vector3f away = Eigen::Vector3f(-0.8F, 0.1F, 0.6F).normalized();
  EXPECT_GT(sky.radiance(away).z(), 1.1F * sky.radiance(away).x());
  EXPECT_GT(sky.radiance(day.to_sun).x(), 1.0F);
  EXPECT_EQ(sky.radiance(away), again.radiance(away));
  for (const Eigen::Vector3f& d : {Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 0, -1),
                                   Eigen::Vector3f(-1, -1e-9F, 0)}) {
    EXPECT_TRUE(sky.radiance(d).allFinite());
    EXPECT_TRUE(sky.mirrored(d).allFinite());
  }
}

}  // namespace
}  // namespace urban_nav_sim
