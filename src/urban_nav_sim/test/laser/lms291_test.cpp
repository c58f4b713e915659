// SPDX-License-Identifier: BSD-3-Clause
#include "laser/lms291.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ray_tracing/small_worlds.hpp"
#include "rig/sensor_poses.hpp"

namespace urban_nav_sim {
namespace {

using urban_nav_core::PlanarScan;
using urban_nav_core::Pose;

Eigen::Vector3d beamDirection(const PlanarScan& scan, int beam) {
  const double angle = scan.angle_first + beam * scan.angle_step;
  return {std::cos(angle), std::sin(angle), 0.0};
}

TEST(Lms291, BeamsEndOnTheSurfaceAtTheirOwnTime) {
  const World world = yard();
  const Tracer tracer(world);
  const SteadyMotion motion(1.5, 1.2);
  const Pose T_base_laser = sensorPose("laser_left");
  const Lms291 laser(tracer, T_base_laser, 7, "laser_left", Lms291::Settings::exact());
  const PlanarScan scan = laser.scan(motion, 0.3, 1000, 0);
  ASSERT_EQ(scan.ranges.size(), 181U);
  EXPECT_EQ(scan.stamp, 1000);
  EXPECT_NEAR(scan.time_step, 18.525e-6, 1e-9);
  int on_ground = 0, on_wall = 0;
  for (int beam = 0; beam < 181; ++beam) {
    const auto range = static_cast<double>(scan.ranges[static_cast<std::size_t>(beam)]);
    if (!std::isfinite(range)) continue;
    const Pose T = motion.at(0.3 + beam * scan.time_step).T_world_base * T_base_laser;
    const Eigen::Vector3d p = T * (range * beamDirection(scan, beam));
    const Eigen::Vector3d normal(std::sin(0.35), -std::cos(0.35), 0.0);
    const double to_wall = std::abs(normal.dot(p - Eigen::Vector3d(-20, 4, 0))), to_ground = std::abs(p.z());
    EXPECT_LT(std::min(to_wall, to_ground), 1e-5) << beam;
    on_ground += to_ground < 1e-5;
    on_wall += to_wall < 1e-5;
  }
  EXPECT_GT(on_ground, 40);
  EXPECT_GT(on_wall, 40);
}

TEST(Lms291, ScansItsSideUpwardsAndTheRightOneDownwards) {
  const World world = yard();
  const Tracer tracer(world);
  const Lms291 left(tracer, sensorPose("laser_left"), 7, "laser_left", Lms291::Settings::exact());
  const Lms291 right(tracer, sensorPose("laser_right"), 7, "laser_right", Lms291::Settings::exact());
  const auto first = left.scan(SteadyMotion(), 0.0, 0, 0), second = right.scan(SteadyMotion(), 0.0, 0, 0);
  EXPECT_NEAR(first.ranges.front(), 0.75 * std::sqrt(2.0), 1e-5);
  EXPECT_NEAR(second.ranges.back(), 0.75 * std::sqrt(2.0), 1e-5);
  EXPECT_TRUE(std::isinf(second.ranges.front()));  // above the hedge: sky
  EXPECT_EQ(second.intensities.front(), 0.0F);
}

TEST(Lms291, HasTheErrorsOfItsDataSheet) {
  const World world = yard();
  const Tracer tracer(world);
  const Lms291 laser(tracer, sensorPose("laser_left"), 7, "laser_left", Lms291::Settings());
  EXPECT_LE(std::abs(laser.bias()), 5e-3);
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    std::vector<BeamTruth> truth;
    const PlanarScan scan = laser.scan(SteadyMotion(), 0.0, 0, i, &truth);
    for (std::size_t beam = 0; beam < 60; ++beam) {
      const auto range = static_cast<double>(scan.ranges[beam]);
      EXPECT_NEAR(range * 1000.0, std::round(range * 1000.0), 1e-3);
      EXPECT_EQ(scan.intensities[beam], std::round(scan.intensities[beam]));
      const double error = range - truth[beam].range;
      sum += error, squares += error * error, ++count;
    }
  }
  const double mean = sum / count, sigma = std::sqrt(squares / count - mean * mean);
  EXPECT_NEAR(mean, laser.bias(), 3e-4);
  EXPECT_NEAR(sigma, 5e-3, 3e-4);
  Lms291::Settings faulty;
  faulty.systematic_error = 0.035;
  const Lms291 other(tracer, sensorPose("laser_left"), 7, "laser_left", faulty);
  EXPECT_NEAR(other.scan(SteadyMotion(), 0, 0, 3).ranges[10] - laser.scan(SteadyMotion(), 0, 0, 3).ranges[10], 0.035,
              1.1e-3);
}

TEST(Lms291, EachDefectIsSwitchedByItself) {
  const World world = yard();
  const Tracer tracer(world);
  const auto makeScan = [&](const Lms291::Settings& settings, std::vector<BeamTruth>& truth) {
    return Lms291(tracer, sensorPose("laser_right"), 7, "laser_right", settings)
        .scan(SteadyMotion(), 0.0, 0, 0, &truth);
  };
  std::vector<BeamTruth> truth;
  const PlanarScan exact = makeScan(Lms291::Settings::exact(), truth);
  Lms291::Settings stepped = Lms291::Settings::exact(), losing = stepped, mixing = stepped;
  stepped.step = 1e-3;
  losing.loses = true;
  mixing.mixes = true;
  const PlanarScan in_steps = makeScan(stepped, truth), with_losses = makeScan(losing, truth),
                   mixed = makeScan(mixing, truth);
  int lost = 0, moved = 0;
  for (std::size_t beam = 0; beam < truth.size(); ++beam) {
    if (!(truth[beam].range < 32.0)) continue;
    EXPECT_NEAR(exact.ranges[beam], truth[beam].range, 1e-6 * truth[beam].range) << beam;
    EXPECT_NEAR(in_steps.ranges[beam], std::round(1000.0 * truth[beam].range) / 1000.0, 1e-5) << beam;
    if (std::isinf(with_losses.ranges[beam])) ++lost;
    else EXPECT_EQ(with_losses.ranges[beam], exact.ranges[beam]) << beam;
    moved += mixed.ranges[beam] != exact.ranges[beam];
  }
  EXPECT_LT(lost, 60);
  EXPECT_GT(moved, 3);  // the hedge
}

TEST(Lms291, EdgesMixAndOnlyEdgesDo) {
  World world = emptyWorld();
  world.parts.push_back(quad(kWall, {-20, 4, -10}, {40, 0, 0}, {0, 0, 30}));
  world.parts.push_back(quad(kWall, {-1, 3, -10}, {2, 0, 0}, {0, 0, 10.77F}));  // its rim within a beam
  const Tracer tracer(world);
  Lms291::Settings settings;
  settings.sigma = 0.0;
  settings.largest_bias = 0.0;
  const Lms291 laser(tracer, sensorPose("laser_left"), 7, "laser_left", settings);
  std::vector<BeamTruth> truth;
  const PlanarScan scan = laser.scan(SteadyMotion(), 0.0, 0, 0, &truth);
  int mixed = 0;
  for (std::size_t beam = 0; beam < 181; ++beam)
    mixed += std::abs(static_cast<double>(scan.ranges[beam]) - truth[beam].range) > 0.01;
  EXPECT_GE(mixed, 1);
  EXPECT_LE(mixed, 3);
}

TEST(Lms291, ReflectsAsMuchAsTheRealOnes) {
  const World world = yard();
  const Tracer tracer(world);
  const Lms291 laser(tracer, sensorPose("laser_left"), 7, "laser_left", Lms291::Settings());
  std::vector<float> ground, wall;
  for (std::uint64_t i = 0; i < 50; ++i) {
    std::vector<BeamTruth> truth;
    const PlanarScan scan = laser.scan(SteadyMotion(1.0), 0.02 * static_cast<double>(i), 0, i, &truth);
    for (std::size_t beam = 0; beam < 181; ++beam) {
      if (truth[beam].surface_class == world.materials[kGround].surface_class && truth[beam].range < 1.5)
        ground.push_back(scan.intensities[beam]);
      if (truth[beam].surface_class == SurfaceClass::TexturedWall) wall.push_back(scan.intensities[beam]);
    }
  }
  const auto median = [](std::vector<float> v) {
    std::sort(v.begin(), v.end());
    return v.at(v.size() / 2);
  };
  EXPECT_GT(median(ground), 25.0F);
  EXPECT_LT(median(ground), 60.0F);
  EXPECT_GT(median(wall), 40.0F);
  EXPECT_LT(median(wall), 110.0F);
}

}  // namespace
}  // namespace urban_nav_sim
