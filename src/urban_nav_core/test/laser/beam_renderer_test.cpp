// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/beam_renderer.hpp"

#include <gtest/gtest.h>

#include <random>

namespace urban_nav_core {
namespace {

constexpr StampNs kFrame = 50'000'000;
constexpr StampNs kGap = 200'000'000;

/// A drive with turns about all axes, far from the origin of the world.
Trajectory drive(int frames, const Vector3d& start = {2000.0, -3000.0, 50.0}) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1.0);
  Trajectory trajectory;
  Pose T(Quaterniond(0.6, 0.1, -0.2, 0.7), start);
  for (int i = 0; i < frames; ++i) {
    trajectory.append(1'000'000'000'000 + i * kFrame, T);
    Vector6d step;
    for (int k = 0; k < 6; ++k) step(k) = noise(random) * (k < 3 ? 0.05 : 0.03);
    T = T * expSe3(step);
  }
  return trajectory;
}

Scan turn(StampNs stamp, int beams, StampNs step) {
  Scan scan;
  scan.stamp = stamp;
  for (int i = 0; i < beams; ++i) {
    const double angle = 0.01 * i - 1.0;
    Beam beam;
    beam.stamp = stamp + i * step;
    beam.direction = Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0).cast<float>();
    beam.range = 2.0F + 0.3F * static_cast<float>(i % 40);
    beam.intensity = static_cast<float>(i % 256);
    scan.beams.push_back(beam);
  }
  return scan;
}

const Pose kLaser(Quaterniond(0.5, -0.5, 0.4, 0.6), {0.3, -0.25, 0.9});

TEST(BeamRenderer, PlacesEachBeamByThePoseAtItsTime) {
  const Trajectory trajectory = drive(40);
  const Pose T_frame_world = trajectory[20].pose.inverse();
  BeamRenderer renderer(trajectory, kLaser, T_frame_world, kGap);
  for (const int first : {0, 1, 17, 3, 38}) {  // also back in time
    const Scan scan = turn(trajectory[static_cast<std::size_t>(first)].stamp, 180, 270'000);
    std::vector<LaserPoint> points;
    EXPECT_EQ(renderer.render(scan, points), 0U);
    ASSERT_EQ(points.size(), scan.beams.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Beam& beam = scan.beams[i];
      const Pose T_frame_laser = T_frame_world * *trajectory.at(beam.stamp, kGap) * kLaser;
      const Vector3d p = T_frame_laser * (beam.range * beam.direction).cast<double>();
      EXPECT_LT((points[i].p.cast<double>() - p).norm(), 2e-6);
      EXPECT_LT((points[i].origin.cast<double>() - T_frame_laser.t()).norm(), 1e-6);
      EXPECT_EQ(points[i].stamp, beam.stamp);
      EXPECT_EQ(points[i].range, beam.range);
      EXPECT_EQ(points[i].intensity, beam.intensity);
    }
  }
}

TEST(BeamRenderer, LeavesOutBeamsWithoutAPoseAndCountsThem) {
  Trajectory trajectory;
  for (const StampNs stamp : {0L, 1L, 2L, 9L, 10L}) trajectory.append(stamp * kFrame, Pose());
  BeamRenderer renderer(trajectory, kLaser, Pose(), kGap);
  std::vector<LaserPoint> points;
  EXPECT_EQ(renderer.render(turn(-kFrame, 2, kFrame), points), 1U) << "the second is at the first pose";
  EXPECT_EQ(renderer.render(turn(2 * kFrame, 9, kFrame), points), 6U) << "both poses next to the gap are covered";
  EXPECT_EQ(renderer.render(turn(10 * kFrame, 3, kFrame), points), 2U);
  EXPECT_EQ(points.size(), 1U + 3U + 1U);
  for (const Trajectory& none : {Trajectory(), drive(1)}) {
    BeamRenderer nowhere(none, kLaser, Pose(), kGap);
    EXPECT_EQ(nowhere.render(turn(none.empty() ? 0 : none.front().stamp, 5, 1), points), 5U);
  }
}

TEST(BeamRenderer, AWallScannedInATurnOnTheSpotIsFlat) {
  // Without the time of each beam it would be bent by 13 ms of the turn.
  Trajectory trajectory;
  for (int i = 0; i < 20; ++i) trajectory.append(i * kFrame, Pose(expSo3({0.0, 0.0, 0.1 * i}), {0.0, 0.0, 0.0}));
  const Pose T_base_laser(Quaterniond::Identity(), {0.0, 0.0, 0.5});
  Scan scan;
  for (int i = 0; i < 700; ++i) {
    Beam beam;
    beam.stamp = i * 1'300'000;
    const double heading = 2.0 * 1e-9 * static_cast<double>(beam.stamp), angle = 0.5 * std::sin(0.01 * i) - heading;
    beam.direction = Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0).cast<float>();
    beam.range = static_cast<float>(4.0 / std::cos(angle + heading));  // a wall 4 m ahead in the world
    scan.beams.push_back(beam);
  }
  std::vector<LaserPoint> points;
  EXPECT_EQ(BeamRenderer(trajectory, T_base_laser, Pose(), kGap).render(scan, points), 0U);
  for (const LaserPoint& point : points) EXPECT_NEAR(point.p.x(), 4.0F, 1e-5F);
}

}  // namespace
}  // namespace urban_nav_core
