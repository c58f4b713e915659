// SPDX-License-Identifier: BSD-3-Clause
#include "lidar/lidar3d.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ray_tracing/small_worlds.hpp"
#include "rig/sensor_poses.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "world/tunnel.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector3d;
using urban_nav_core::Beam;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Sweep;

constexpr StampNs kStamp = 1'000'000'000'000;
constexpr LidarModel kSixteen{LidarModel::Pattern::Rings, 16};

double secondsBeforeEnd(const Beam& beam) { return 1e-9 * static_cast<double>(kStamp - beam.stamp); }

Vector3d endpoint(const Beam& beam, const Motion& motion, double t_end) {
  const Pose T_world_lidar = motion.at(t_end - secondsBeforeEnd(beam)).T_world_base * lidarPose();
  return T_world_lidar * (static_cast<double>(beam.range) * beam.direction.cast<double>());
}

TEST(Lidar3d, BeamsEndOnTheSurfaceAtTheirOwnTimes) {
  const World world = yard();
  const Tracer tracer(world);
  const SteadyMotion motion(8.0, 1.2);
  for (const LidarModel& model : {kSixteen, LidarModel{LidarModel::Pattern::Rosette, 6}}) {
    const Lidar3d lidar(tracer, lidarPose(), 7, model, Lidar3d::Settings::exact());
    SweepTruth truth;
    const double t_end = 0.4;
    const Sweep sweep = lidar.sweep(motion, t_end, kStamp, 2, &truth);
    EXPECT_EQ(sweep.times, Sweep::Times::Measured);
    EXPECT_EQ(sweep.reference, kStamp - 50'000'000);
    const Vector3d slanted(std::sin(0.35), -std::cos(0.35), 0.0);
    int on_wall = 0, on_ground = 0, on_box = 0;
    for (const Beam& beam : sweep.beams) {
      const Vector3d p = endpoint(beam, motion, t_end);
      const double t = t_end - secondsBeforeEnd(beam);
      const double to_ground = std::abs(p.z()), to_wall = std::abs(p.x() - 6.0),
                   to_slanted = std::abs(slanted.dot(p - Vector3d(-20, 4, 0)));
      const bool is_box = std::abs(p.x() - 4.0) < 1e-4 && std::abs(p.y() - t) < 0.5 + 1e-4;
      const bool is_hedge = p.y() < -2.5 && p.y() > -4.0;
      ASSERT_TRUE(std::min({to_ground, to_wall, to_slanted}) < 1e-4 || is_box || is_hedge) << p.transpose();
      on_ground += to_ground < 1e-4;
      on_wall += to_wall < 1e-4;
      on_box += is_box;
      const auto place = static_cast<std::size_t>(beam.ring * truth.columns + beam.column);
      ASSERT_EQ(beam.range, truth.range[place]);
    }
    EXPECT_GT(on_ground, 1000);
    EXPECT_GT(on_wall, 300);
    EXPECT_GT(on_box, 30);  // it moves by 0.1 m within the sweep
  }
}

TEST(Lidar3d, BeamsComeInOrderOfTimeAndRingsInOrderOfElevation) {
  const World world = yard();
  const Tracer tracer(world);
  const Lidar3d lidar(tracer, lidarPose(), 7, kSixteen, Lidar3d::Settings());
  const Sweep sweep = lidar.sweep(SteadyMotion(), 0.2, kStamp, 0);
  ASSERT_GT(sweep.beams.size(), 10000U);
  for (std::size_t i = 1; i < sweep.beams.size(); ++i) {
    const Beam &a = sweep.beams[i - 1], &b = sweep.beams[i];
    ASSERT_GT(b.stamp, a.stamp);
    ASSERT_TRUE(b.column > a.column || (b.column == a.column && b.ring > a.ring));
    ASSERT_TRUE(b.column != a.column || b.direction.z() > a.direction.z());
  }
  EXPECT_GE(sweep.beams.front().stamp, kStamp - 100'000'000);
  EXPECT_LT(sweep.beams.back().stamp, kStamp);
}

TEST(Lidar3d, WithoutTimesAllBeamsHaveTheStampOfTheEnd) {
  const World world = yard();
  const Tracer tracer(world);
  Lidar3d::Settings settings = Lidar3d::Settings::exact();
  settings.has_times = false;
  const Sweep sweep = Lidar3d(tracer, lidarPose(), 7, kSixteen, settings).sweep(SteadyMotion(), 0.2, kStamp, 0);
  EXPECT_EQ(sweep.times, Sweep::Times::Unknown);
  for (const Beam& beam : sweep.beams) ASSERT_EQ(beam.stamp, kStamp);
}

TEST(Lidar3d, TunnelWallsAreAtTheirDistance) {
  const World world = buildWorld("tunnel", 7, 1);
  const Tracer tracer(world);
  const Lidar3d lidar(tracer, lidarPose(), 7, kSixteen, Lidar3d::Settings::exact());
  const SteadyMotion motion(1.2);
  const Sweep sweep = lidar.sweep(motion, 0.2, kStamp, 0);
  int walls = 0, floor = 0;
  for (const Beam& beam : sweep.beams) {
    const Vector3d p = endpoint(beam, motion, 0.2);
    if (p.z() > kTunnelSpring) continue;
    if (p.z() < 1e-4) {
      EXPECT_NEAR(p.z(), 0.0, 1e-4);
      ++floor;
    } else {
      ASSERT_NEAR(std::abs(p.y()), kTunnelHalfWidth, 1e-4) << p.transpose();
      ++walls;
    }
  }
  EXPECT_GT(walls, 2000);
  EXPECT_GT(floor, 2000);
}

TEST(Lidar3d, HasTheErrorsOfItsSettings) {
  const World world = yard();
  const Tracer tracer(world);
  Lidar3d::Settings settings;
  settings.step = 0.0;
  settings.mixes = settings.loses = false;
  settings.ring_angle_sigma = 0.0;
  const Lidar3d lidar(tracer, lidarPose(), 7, kSixteen, settings);
  std::vector<double> sum(16, 0.0), squares(16, 0.0), count(16, 0.0);
  for (std::uint64_t number = 0; number < 4; ++number) {
    SweepTruth truth;
    const Sweep sweep = lidar.sweep(SteadyMotion(), 0.2, kStamp, number, &truth);
    for (const Beam& beam : sweep.beams) {
      const auto place = static_cast<std::size_t>(beam.ring * truth.columns + beam.column);
      const double error = static_cast<double>(beam.range) - static_cast<double>(truth.range[place]);
      sum[beam.ring] += error, squares[beam.ring] += error * error, ++count[beam.ring];
    }
  }
  double spread = 0.0;
  for (std::size_t ring = 0; ring < 16; ++ring) {
    ASSERT_GT(count[ring], 1000.0);
    const double mean = sum[ring] / count[ring];
    EXPECT_NEAR(mean, lidar.ringErrors()[ring].range, 5.0 * 0.02 / std::sqrt(count[ring]));
    EXPECT_NEAR(std::sqrt(squares[ring] / count[ring] - mean * mean), 0.02, 0.002);
    spread += lidar.ringErrors()[ring].range * lidar.ringErrors()[ring].range / 16.0;
  }
  EXPECT_GT(std::sqrt(spread), 0.004);
  EXPECT_LT(std::sqrt(spread), 0.02);
}

TEST(Lidar3d, MixesEchoesAtEdgesAndLosesSome) {
  const World world = yard();
  const Tracer tracer(world);
  Lidar3d::Settings mixing = Lidar3d::Settings::exact();
  mixing.mixes = true;
  SweepTruth truth;
  const Sweep mixed = Lidar3d(tracer, lidarPose(), 7, kSixteen, mixing).sweep(SteadyMotion(), 0.2, kStamp, 0, &truth);
  int between = 0;
  for (const Beam& beam : mixed.beams) {
    const auto place = static_cast<std::size_t>(beam.ring * truth.columns + beam.column);
    between += std::abs(beam.range - truth.range[place]) > 0.05F;
  }
  EXPECT_GT(between, 20);
  EXPECT_LT(between, static_cast<int>(mixed.beams.size()) / 10);
  Lidar3d::Settings losing = Lidar3d::Settings::exact();
  losing.loses = true;
  const Sweep all =
      Lidar3d(tracer, lidarPose(), 7, kSixteen, Lidar3d::Settings::exact()).sweep(SteadyMotion(), 0.2, kStamp, 0);
  const Sweep some = Lidar3d(tracer, lidarPose(), 7, kSixteen, losing).sweep(SteadyMotion(), 0.2, kStamp, 0);
  EXPECT_LT(some.beams.size(), all.beams.size());
  EXPECT_GT(some.beams.size(), all.beams.size() / 2);
}

TEST(Lidar3d, SameBeamsWhateverTheThreads) {
  const World world = yard();
  const Tracer tracer(world);
  const Lidar3d lidar(tracer, lidarPose(), 7, kSixteen, Lidar3d::Settings());
  const SteadyMotion motion(1.5, 0.5);
  std::vector<Sweep> sweeps;
  for (const int threads : {1, 2, 5}) {
    const urban_nav_core::ThreadLimit limit(threads);
    sweeps.push_back(lidar.sweep(motion, 0.3, kStamp, 4));
  }
  for (const Sweep& sweep : sweeps) {
    ASSERT_EQ(sweep.beams.size(), sweeps[0].beams.size());
    for (std::size_t i = 0; i < sweep.beams.size(); ++i) {
      ASSERT_EQ(sweep.beams[i].range, sweeps[0].beams[i].range);
      ASSERT_EQ(sweep.beams[i].intensity, sweeps[0].beams[i].intensity);
      ASSERT_EQ(sweep.beams[i].stamp, sweeps[0].beams[i].stamp);
    }
  }
}

}  // namespace
}  // namespace urban_nav_sim
