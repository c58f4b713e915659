// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lo/lo_recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "map/trajectory_files.hpp"
#include "topics/lo/lo_files.hpp"
#include "topics/lo/lo_run_state.hpp"
#include "topics/lo/lo_summary.hpp"

namespace urban_nav {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A sweep in the middle of a room of 12 x 10 x 4 m, from `x` m ahead of its middle; at rest.
urban_nav_input::SweepInput makeSweep(double x, int number) {
  urban_nav_input::SweepInput input;
  input.role = "points0";
  urban_nav_core::Sweep& sweep = input.sweep;
  sweep.reference = 1'000'000'000 + 100'000'000LL * number;
  sweep.duration = 0.1;
  sweep.times = urban_nav_core::Sweep::Times::Deskewed;
  for (int column = 0; column < 720; ++column)
    for (int ring = 0; ring < 24; ++ring) {
      const double azimuth = column * kPi / 360.0, elevation = (ring - 12) * kPi / 90.0;
      const Eigen::Vector3d d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                              std::sin(elevation));
      double range = 1e9;
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d low(-6.0 - x, -5.0, -1.5), high(6.0 - x, 5.0, 2.5);
        if (std::abs(d[i]) > 1e-9) range = std::min(range, (d[i] > 0.0 ? high[i] : low[i]) / d[i]);
      }
      urban_nav_core::Beam beam;
      beam.stamp = sweep.reference;
      beam.direction = d.cast<float>();
      beam.range = static_cast<float>(range);
      sweep.beams.push_back(beam);
    }
  return input;
}

urban_nav_input::SourceInfo someInfo() {
  urban_nav_input::SourceInfo info;
  info.name = "room";
  info.has_images = false;
  return info;
}

TEST(LoRecorder, AMovedRoomIsFollowedAndTheStateContinuesBitByBit) {
  LoRun whole, part, rest;
  LoRecorder recorder(laser_odometry::Parameters(), someInfo(), whole);
  LoRecorder first(laser_odometry::Parameters(), someInfo(), part);
  for (int i = 0; i < 3; ++i) {
    recorder.process(makeSweep(0.1 * i, i));
    first.process(makeSweep(0.1 * i, i));
  }
  LoRecorder second(laser_odometry::Parameters(), someInfo(), rest, first.state());
  for (int i = 3; i < 6; ++i) {
    recorder.process(makeSweep(0.1 * i, i));
    second.process(makeSweep(0.1 * i, i));
  }
  recorder.finish({{"a fault"}, {}});
  second.finish({{"a fault"}, {}});
  ASSERT_EQ(whole.settled.size(), 6U);
  EXPECT_NEAR(whole.settled.back().T_odom_base.pose.t().x(), 0.5, 0.01);
  EXPECT_EQ(whole.source, OdometrySource::Laser);
  EXPECT_EQ(rest.input, "room");
  EXPECT_EQ(sweepsCsv(rest), sweepsCsv(whole));
  const auto trajectories = odometryTrajectories({&whole}), again = odometryTrajectories({&rest});
  const auto files = trajectoryFiles({&whole}, trajectories), files_again = trajectoryFiles({&rest}, again);
  for (std::size_t i = 0; i < files.size(); ++i) EXPECT_EQ(files_again[i].content(), files[i].content()) << i;

  const std::optional<LoRun> back = unpackLoRun(packLoRun(whole));
  ASSERT_TRUE(back);
  EXPECT_EQ(packLoRun(*back), packLoRun(whole));
  const LoSummary summary = summariseLo({&whole});
  EXPECT_EQ(summary.sweeps, 6);
  EXPECT_EQ(summary.status_counts.at("OK"), 6);
  EXPECT_EQ(summary.degenerate, 0);
  ASSERT_EQ(summary.warnings.size(), 1U);
  EXPECT_EQ(summary.warnings.front(), "a fault");
}

TEST(LoRecorder, OtherLidarsAndSweepsWithoutTimesAreNamed) {
  LoRun run;
  LoRecorder recorder(laser_odometry::Parameters(), someInfo(), run);
  for (int i = 0; i < 3; ++i) {
    urban_nav_input::SweepInput sweep = makeSweep(0.0, i);
    sweep.sweep.times = urban_nav_core::Sweep::Times::Unknown;
    recorder.process(sweep);
    sweep.role = "points1";
    recorder.process(sweep);
  }
  recorder.finish({});
  ASSERT_EQ(run.faults.size(), 2U);
  EXPECT_NE(run.faults[0].find("3 sweeps of other LiDARs"), std::string::npos) << run.faults[0];
  EXPECT_NE(run.faults[1].find("not deskewed"), std::string::npos) << run.faults[1];
  EXPECT_EQ(run.frames.size(), 3U);
}

TEST(LoRecorder, APlanarLaserGivesPlanarMotionAndContinuesBitByBit) {
  const auto makeScan = [](double x, int number) {
    urban_nav_input::SweepInput input = makeSweep(x, number);
    input.role = "laser0";
    input.is_planar = true;
    auto& beams = input.sweep.beams;
    beams.erase(std::remove_if(beams.begin(), beams.end(),
                               [](const urban_nav_core::Beam& beam) { return std::abs(beam.direction.z()) > 1e-6F; }),
                beams.end());
    return input;
  };
  LoRun whole, part, rest;
  LoRecorder recorder(laser_odometry::Parameters(), someInfo(), whole);
  LoRecorder first(laser_odometry::Parameters(), someInfo(), part);
  for (int i = 0; i < 3; ++i) {
    recorder.process(makeScan(0.05 * i, i));
    first.process(makeScan(0.05 * i, i));
  }
  LoRecorder second(laser_odometry::Parameters(), someInfo(), rest, first.state());
  for (int i = 3; i < 6; ++i) {
    recorder.process(makeScan(0.05 * i, i));
    second.process(makeScan(0.05 * i, i));
  }
  EXPECT_TRUE(rest.is_planar);
  EXPECT_EQ(sweepsCsv(rest), sweepsCsv(whole));
  EXPECT_NE(sweepsCsv(whole).find(",OK,planar,"), std::string::npos) << sweepsCsv(whole);
  EXPECT_NEAR(whole.settled.back().T_odom_base.pose.t().x(), 0.25, 0.01);
  EXPECT_EQ(packLoRun(*unpackLoRun(packLoRun(whole))), packLoRun(whole));
}

TEST(LoRecorder, SweepsWithoutReturnsAreRowsOfTheFile) {
  LoRun run;
  LoRecorder recorder(laser_odometry::Parameters(), someInfo(), run);
  recorder.process(makeSweep(0.0, 0));
  urban_nav_input::SweepInput empty = makeSweep(0.0, 1);
  empty.sweep.beams.clear();
  recorder.process(empty);
  const std::string csv = sweepsCsv(run);
  EXPECT_EQ(csv.find("stamp_ns,status,reason,points,used,moving,free_directions\n1000000000,OK,,"), 0U) << csv;
  EXPECT_NE(csv.find("\n1100000000,LOST,no_points,0,0,0,1 0 0 0 0 0 0 1 0 0 0 0"), std::string::npos) << csv;
}

TEST(LoRun, DamagedBytesAreNoRun) {
  LoRun run;
  LoRecorder recorder(laser_odometry::Parameters(), someInfo(), run);
  recorder.process(makeSweep(0.0, 0));
  const std::string bytes = packLoRun(run);
  for (std::size_t cut = 0; cut < bytes.size(); cut += bytes.size() / 20 + 1)
    EXPECT_FALSE(unpackLoRun(bytes.substr(0, cut))) << cut;
}

}  // namespace
}  // namespace urban_nav
