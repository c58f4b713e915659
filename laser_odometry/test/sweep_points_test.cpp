// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_points.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/spinning_lidar.hpp"

namespace laser_odometry {
namespace {

TEST(SweepPoints, DeskewedPointsAreThoseAtTheReferenceTime) {
  SpinningLidar lidar;
  lidar.sigma_m = 0.0;
  lidar.T_base_lidar = Pose(urban_nav_core::expSo3({0.0, 0.1, 0.2}), {0.5, 0.0, 0.2});
  const auto motion = makeDrive(10.0, 1.0);
  const SweepPoints points = collectPoints(lidar.scan(makeRoom(), motion, 0.1, 1), lidar.T_base_lidar, 0.5, 80.0, 1.0);
  Vector6d twist;
  twist << 10.0, 0, 0, 0, 0, 1.0;
  const Pose T_world_base = motion(0.1);
  const std::vector<Vector3d> moved = deskew(points, {twist, Vector6d::Zero()});
  ASSERT_GT(moved.size(), 1000u);
  int on_floor = 0;
  for (const Vector3d& p : moved) {
    const Vector3d world = T_world_base * p;
    if (std::abs(world.x() - 8.0) > 0.1 && std::abs(world.z()) < 0.5 && world.x() < 3.5 && world.x() > -4.5) {
      on_floor += std::abs(world.z()) < 1e-4 ? 1 : 0;
    }
    EXPECT_GT(world.z(), -1e-4);
    EXPECT_LT(world.x(), 8.0 + 1e-4);
  }
  EXPECT_GT(on_floor, 100);
}

TEST(SweepPoints, OnlyFiniteBeamsBetweenTheRangesCount) {
  Sweep sweep;
  sweep.times = Sweep::Times::Measured;
  const auto add = [&sweep](float range, StampNs stamp) {
    urban_nav_core::Beam beam;
    beam.range = range;
    beam.stamp = stamp;
    sweep.beams.push_back(beam);
  };
  add(5.0F, 0);
  add(0.5F, 0);
  add(500.0F, 0);
  add(std::numeric_limits<float>::quiet_NaN(), 0);
  add(std::numeric_limits<float>::infinity(), 0);
  add(-3.0F, 0);
  add(5.0F, std::numeric_limits<StampNs>::max());
  const SweepPoints points = collectPoints(sweep, {}, 1.0, 100.0, 1.0);
  EXPECT_EQ(points.p.size(), 1u);
  EXPECT_EQ(points.near, 1);
  EXPECT_EQ(points.valid, 4);
}

TEST(SweepPoints, WithoutTimesNothingMoves) {
  SpinningLidar lidar;
  Sweep sweep = lidar.scan(makeRoom(), makeDrive(0, 0), 0.0, 1);
  sweep.times = Sweep::Times::Unknown;
  const SweepPoints points = collectPoints(sweep, {}, 0.5, 80.0, 1.0);
  const std::vector<Vector3d> moved = deskew(points, {10.0 * Vector6d::Ones(), Vector6d::Ones()});
  for (std::size_t i = 0; i < moved.size(); ++i) EXPECT_EQ(moved[i], points.p[i].cast<double>());
}

}  // namespace
}  // namespace laser_odometry
