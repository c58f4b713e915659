// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/spinning_lidar.hpp"
#include "surface_map.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace laser_odometry {
namespace {

TEST(SweepPoints, DeskewedSegmentsAreThoseAtTheReferenceTime) {
  SpinningLidar lidar;
  lidar.sigma_m = 0.0;
  lidar.T_base_lidar = Pose(urban_nav_core::expSo3({0.0, 0.1, 0.2}), {0.5, 0.0, 0.2});
  const auto motion = makeDrive(10.0, 1.0);
  const SweepPoints points =
      collectPoints(lidar.scan(makeRoom(), motion, 0.1, 1), lidar.T_base_lidar, {0.5, 80.0, 1.0, 0.25});
  Vector6d twist;
  twist << 10.0, 0, 0, 0, 0, 1.0;
  const Pose T_world_base = motion(0.1);
  const std::vector<Segment> moved = deskew(points, {twist, Vector6d::Zero()});
  ASSERT_GT(moved.size(), 500u);
  int on_floor = 0;
  for (const Segment& segment : moved) {
    const Vector3d world = T_world_base * segment.mean;
    const Matrix3d C = T_world_base.R() * segment.covariance * T_world_base.R().transpose();
    on_floor += std::abs(world.z()) < 1e-4 && C(2, 2) < 1e-8 ? 1 : 0;
    EXPECT_GT(world.z(), -1e-4);
    EXPECT_LT(world.x(), 8.0 + 1e-4);
  }
  EXPECT_GT(on_floor, 50);
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
  const SweepPoints points = collectPoints(sweep, {}, {1.0, 100.0, 1.0, 0.25});
  EXPECT_EQ(points.used, 1);
  EXPECT_EQ(points.segments.size(), 1u);
  EXPECT_EQ(points.near, 1);
  EXPECT_EQ(points.valid, 4);
}

TEST(SweepPoints, WithoutTimesNothingMoves) {
  SpinningLidar lidar;
  Sweep sweep = lidar.scan(makeRoom(), makeDrive(0, 0), 0.0, 1);
  sweep.times = Sweep::Times::Unknown;
  const SweepPoints points = collectPoints(sweep, {}, {0.5, 80.0, 1.0, 0.25});
  const std::vector<Segment> moved = deskew(points, {10.0 * Vector6d::Ones(), Vector6d::Ones()});
  for (std::size_t i = 0; i < moved.size(); ++i) EXPECT_EQ(moved[i].mean, points.segments[i].mean);
}

TEST(SweepPoints, SegmentsHoldAllReturnsOfOneRingWithinTheirLength) {
  Sweep sweep;
  urban_nav_core::testing::Dice dice(3);
  for (std::uint16_t column = 0; column < 400; ++column)
    for (std::uint16_t ring = 0; ring < 4; ++ring) {
      if (dice.uniform(0.0, 1.0) < 0.1) continue;
      const double angle = 2e-3 * column, slope = 0.05 * ring;
      urban_nav_core::Beam beam;
      beam.ring = ring;
      beam.column = column;
      beam.direction = Vector3d(std::cos(angle), std::sin(angle), slope).normalized().cast<float>();
      beam.range = static_cast<float>((column < 200 ? 8.0 : 12.0) + 0.02 * dice.normal());
      sweep.beams.push_back(beam);
    }
  const SweepPoints points = collectPoints(sweep, {}, {1.0, 100.0, 1.0, 0.25});
  double count = 0.0;
  Vector3d sum = Vector3d::Zero(), expected = Vector3d::Zero();
  for (const Segment& segment : points.segments) {
    count += segment.count;
    sum += segment.count * segment.mean;
    EXPECT_LT(segment.covariance.trace(), 0.25 * 0.25);
    const double range = segment.mean.norm();
    EXPECT_TRUE(std::abs(range - 8.0) < 0.1 || std::abs(range - 12.0) < 0.1) << range << " m: two surfaces in one";
    const double ring = segment.mean.z() / segment.mean.head<2>().norm() / 0.05;
    EXPECT_NEAR(ring, std::round(ring), 0.01);
  }
  for (const urban_nav_core::Beam& beam : sweep.beams) expected += (beam.range * beam.direction).cast<double>();
  EXPECT_EQ(count, static_cast<double>(sweep.beams.size()));
  EXPECT_LT((sum - expected).norm(), 1e-2);
  EXPECT_LT(points.segments.size(), sweep.beams.size() / 4);
}

/// A wall across y = 2 whose ranges have a standard deviation of 2 cm, in cubes with a border at that distance.
TEST(SweepPoints, AWallAtTheBorderOfTwoCubesIsNotDividedByItsNoise) {
  SpinningLidar lidar;
  lidar.sigma_m = 0.02;
  BoxWorld world;
  world.boxes.push_back({{-20.0, 2.0, -5.0}, {20.0, 3.0, 5.0}});
  const SweepPoints points = collectPoints(lidar.scan(
                                               world, [](double) { return Pose(); }, 0.0, 1),
                                           {}, {0.5, 8.0, 1.0, 0.25});
  SurfaceMap map(0.5, 1, 100.0);
  map.insert(deskew(points, {}), Vector3d::Zero(), 0);
  double weights = 0.0, squares = 0.0;
  for (const MapCell& cell : map.cells(0)) {
    const Plane plane = fitPlane(cell.moments, cell.centre);
    if (!plane.usable || cell.moments.count < 50.0) continue;
    weights += 1.0;
    squares += (plane.mean.y() - 2.0) * (plane.mean.y() - 2.0);
  }
  ASSERT_GT(weights, 20.0);
  // The halves of a normal distribution are off by 0.8 standard deviations, whatever the number of returns.
  EXPECT_LT(std::sqrt(squares / weights), 0.4 * lidar.sigma_m);
}

}  // namespace
}  // namespace laser_odometry
