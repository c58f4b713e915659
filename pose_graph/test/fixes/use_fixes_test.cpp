// SPDX-License-Identifier: BSD-3-Clause
#include "fixes/use_fixes.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "../support/gps_drive.hpp"

namespace pose_graph {
namespace {

using testing::GpsDrive;
using testing::makeDrive;
using testing::positionError;
using testing::relaxDrive;

double driveError(const GpsDrive& drive, bool gps) { return positionError(drive, relaxDrive(drive, gps).tracks()[0]); }

GpsDrive realisticDrive(unsigned seed, double reflected = 0.0) {
  GpsDrive drive;
  drive.turn_drift = 0.003;
  drive.scale_error = 0.002;
  drive.slow = 1.5;
  drive.white = 0.5;
  drive.reflected = reflected;
  drive.stated = 2.0;
  makeDrive(seed, 2400.0, drive);
  return drive;
}

TEST(UseFixes, MoveNothingWhereOdometryAndFixesAgree) {
  GpsDrive drive;
  makeDrive(1, 900.0, drive);
  const PoseGraph graph = relaxDrive(drive, true);
  EXPECT_LT(positionError(drive, graph.tracks()[0]), 1e-3);
  EXPECT_LT(graph.fixUse().moved, 0.01);
  EXPECT_EQ(graph.fixUse().used, drive.fixes.size());
  EXPECT_EQ(graph.fixUse().rejected + graph.fixUse().unplaced, 0U);
  EXPECT_EQ(graph.fixUse().sigma_factor, 1.0);
}

TEST(UseFixes, BoundTheDriftOfALongPath) {
  double without = 0.0, with = 0.0;
  for (unsigned seed = 1; seed <= 2; ++seed) {
    const GpsDrive drive = realisticDrive(seed);
    without += driveError(drive, false);
    with += driveError(drive, true);
  }
  EXPECT_GT(without / 2.0, 8.0) << "the drift is there";
  EXPECT_LT(with / 2.0, 3.0);
}

TEST(UseFixes, AreOffByDefault) {
  const GpsDrive drive = realisticDrive(1);
  PoseGraph graph{Parameters()};
  graph.beginSession("a");
  for (const urban_nav_core::RelativePose& step : drive.odometry) graph.addOdometry("a", step);
  graph.relax();
  const std::vector<Pose> before = graph.tracks()[0].map;
  graph.putFixes("a", drive.fixes);
  graph.relax();
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_EQ(graph.tracks()[0].map[i].t(), before[i].t()) << i;
}

TEST(UseFixes, LeaveOutReflections) {
  for (unsigned seed = 1; seed <= 2; ++seed) {
    const GpsDrive clean = realisticDrive(seed), reflected = realisticDrive(seed, 40.0);
    const PoseGraph graph = relaxDrive(reflected, true);
    EXPECT_LT(positionError(reflected, graph.tracks()[0]), driveError(clean, true) + 1.0) << seed;
    const std::size_t false_ones = reflected.fixes.size() / 8;
    EXPECT_GT(graph.fixUse().rejected, false_ones * 8 / 10) << seed;
    EXPECT_LT(graph.fixUse().rejected, false_ones * 15 / 10) << seed;
  }
}

TEST(UseFixes, OfAnOverconfidentReceiverAreNoWorseThanOdometry) {
  GpsDrive drive;  // odometry drifts by some decimetres; fixes have errors of metres and overconfident covariances
  drive.turn_drift = 1e-4;
  drive.slow = 5.0;
  drive.white = 1.0;
  drive.stated = 0.5;
  makeDrive(5, 600.0, drive);
  const PoseGraph graph = relaxDrive(drive, true);
  EXPECT_GT(graph.fixUse().sigma_factor, 3.0);
  EXPECT_LT(positionError(drive, graph.tracks()[0]), 3.0);
}

TEST(UseFixes, CountWhatHasNoPlaceOrNoMeaning) {
  GpsDrive drive;
  makeDrive(6, 120.0, drive);
  const std::size_t sound = drive.fixes.size();
  PositionFix odd = drive.fixes.back();
  odd.reading.stamp += 10'000'000'000;  // later than all poses
  drive.fixes.push_back(odd);
  odd.reading.stamp += 1;
  odd.reading.sigma.x() = 0.0;
  drive.fixes.push_back(odd);
  odd.reading.stamp += 1;
  odd.reading.sigma.x() = 1.0;
  odd.reading.height = std::numeric_limits<double>::quiet_NaN();
  drive.fixes.push_back(odd);
  const PoseGraph graph = relaxDrive(drive, true);
  EXPECT_EQ(graph.fixUse().unplaced, 3U);
  EXPECT_EQ(graph.fixUse().used, sound);
  for (const Pose& pose : graph.tracks()[0].map) ASSERT_TRUE(pose.t().allFinite());
}

TEST(UseFixes, AClosureOfCentimetresOutweighsFixesOfMetres) {
  GpsDrive drive = realisticDrive(7);
  Parameters parameters;
  parameters.gps = true;
  PoseGraph graph(parameters);
  graph.beginSession("a");
  for (const urban_nav_core::RelativePose& step : drive.odometry) graph.addOdometry("a", step);
  graph.putFixes("a", drive.fixes);
  const std::size_t last = drive.stamps.size() - 1;
  for (const std::size_t back : {std::size_t{0}, std::size_t{4}, std::size_t{8}}) {
    Closure closure;
    closure.a = {"a", drive.stamps[back]};
    closure.b = {"a", drive.stamps[last - back]};
    closure.measured.T_a_b = drive.truth[back].inverse() * drive.truth[last - back];
    closure.measured.information = 1e4 * urban_nav_core::Matrix6d::Identity();
    graph.addClosure(closure);
  }
  EXPECT_EQ(graph.relax().accepted, 3U);
  const Track& track = graph.tracks()[0];
  const Pose found = track.map[0].inverse() * track.map[last], true_one = drive.truth[0].inverse() * drive.truth[last];
  EXPECT_LT((found.t() - true_one.t()).norm(), 0.3);
  EXPECT_LT(positionError(drive, track), 3.0);
}

TEST(UseFixes, LeaveWhatComesAfterThemWhereTheyHaveIt) {
  const GpsDrive drive = realisticDrive(8);
  PoseGraph graph = relaxDrive(drive, true);
  const std::vector<Pose> relaxed = graph.tracks()[0].map;
  // A closure equal to the current relative pose: the incremental relaxation must not pull the path back to odometry.
  Closure closure;
  closure.a = {"a", drive.stamps[10]};
  closure.b = {"a", drive.stamps[400]};
  closure.measured.T_a_b = relaxed[10].inverse() * relaxed[400];
  closure.measured.information = 100.0 * urban_nav_core::Matrix6d::Identity();
  graph.addClosure(closure);
  graph.update();
  for (std::size_t i = 0; i < relaxed.size(); ++i)
    ASSERT_LT((graph.tracks()[0].map[i].t() - relaxed[i].t()).norm(), 0.02) << i;
}

}  // namespace
}  // namespace pose_graph
