// SPDX-License-Identifier: BSD-3-Clause
#include "window/window.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_core/testing/allocations.hpp"
#include "window/track_runner.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::expSe3;
using urban_nav_core::isApprox;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

urban_nav_core::testing::TrackOptions makeTracks(int frames, double sigma_px, std::uint64_t seed = 3) {
  return mixedMotion(frames, sigma_px, seed);
}

double poseNees(const Pose& truth, const urban_nav_core::PoseWithCovariance& estimate) {
  const Vector6d e = urban_nav_core::boxMinus(truth, estimate.pose);
  return e.dot(estimate.covariance.ldlt().solve(e));
}

TEST(Window, WithoutNoiseWithoutError) {
  auto tracks = simulateTracks(makeTracks(60, 0.0));
  tracks.sigma_px = 0.3;  // stated for the measurements
  for (const int size : {1, 5, 20}) {
    WindowOptions options;
    options.size = size;
    options.iterations = 20;
    options.tolerance = 1e-16;
    TrackRunner run(tracks, options);
    while (!run.done()) {
      run.step();
      ASSERT_LT(urban_nav_core::distanceBetween(run.window.newest().pose, run.truth()), 0.01)
          << "the inputs are off, the images are not";
    }
  }
}

TEST(Window, BackSubstitutionGivesTheBatchWhereTheWorldIsNearlyLinear) {
  const auto tracks = simulateTracks(makeTracks(30, 1e-4));
  WindowOptions small, all;
  small.size = 4;
  small.keep_history = true;
  all.size = 40;
  small.huber = all.huber = 0.0;
  small.iterations = all.iterations = 30;
  small.tolerance = all.tolerance = 1e-16;
  TrackRunner filter(tracks, small), batch(tracks, all);
  while (!filter.done()) {
    filter.step();
    batch.step();
  }
  const auto trajectory = filter.window.trajectory();
  ASSERT_EQ(trajectory.size(), tracks.frames.size());
  double settled_off = 0.0;
  for (const auto& [frame, pose] : trajectory) {
    EXPECT_TRUE(isApprox(pose, batch.window.pose(frame), 1e-8)) << frame;
    if (static_cast<std::size_t>(frame) < filter.settled.size())
      settled_off = std::max(settled_off, urban_nav_core::distanceBetween(
                                              filter.settled[static_cast<std::size_t>(frame)].T_odom_camera.pose,
                                              batch.window.pose(frame)));
  }
  EXPECT_GT(settled_off, 1e-7) << "settled poses do not depend on later measurements";
}

TEST(Window, SettledPosesAreTheProductOfTheirSteps) {
  const auto tracks = simulateTracks(makeTracks(40, 0.5));
  TrackRunner run(tracks, WindowOptions());
  while (!run.done()) run.step();
  for (const SettledPose& pose : run.window.flush()) run.settled.push_back(pose);
  ASSERT_EQ(run.settled.size(), tracks.frames.size());
  for (std::size_t i = 1; i < run.settled.size(); ++i) {
    const Pose product = run.settled[i - 1].T_odom_camera.pose * run.settled[i].T_previous_camera;
    EXPECT_EQ(product.t(), run.settled[i].T_odom_camera.pose.t());
    EXPECT_EQ(product.q().coeffs(), run.settled[i].T_odom_camera.pose.q().coeffs());
    EXPECT_EQ(run.settled[i].relative_covariance.llt().info(), Eigen::Success);
  }
}

TEST(Window, IsConsistent) {
  // Eight runs instead of the bench's fifty: a wide band (99.99 % of the mean of eight chi-squares of six).
  double now = 0.0, relative = 0.0;
  int steps = 0;
  constexpr int kRuns = 8;
  for (int seed = 0; seed < kRuns; ++seed) {
    const auto tracks = simulateTracks(makeTracks(100, 0.5, static_cast<std::uint64_t>(50 + seed)));
    TrackRunner run(tracks, WindowOptions());
    while (!run.done()) run.step();
    now += poseNees(run.truth(), run.window.newest()) / kRuns;
    for (std::size_t i = 1; i < run.settled.size(); ++i, ++steps)
      relative += poseNees(tracks.frames[i - 1].T_world_camera.inverse() * tracks.frames[i].T_world_camera,
                           {run.settled[i].T_previous_camera, run.settled[i].relative_covariance});
  }
  EXPECT_GT(now, 2.3);
  EXPECT_LT(now, 12.0);
  EXPECT_NEAR(relative / steps, 6.0, 1.0);
}

// A correct calibration is kept, and a wrong one is overruled by the images.
TEST(Window, EstimatesTheErrorOfTheCalibration) {
  for (const double offset : {0.0, 0.1, 0.8}) {
    urban_nav_core::testing::TrackOptions motion = makeTracks(120, 0.1);
    motion.features = 60;
    auto tracks = simulateTracks(motion);
    for (auto& frame : tracks.frames)
      for (auto& sighting : frame.sightings) sighting.z.z() -= offset;
    WindowOptions options;
    options.disparity_offset = 0.1;
    TrackRunner run(tracks, options);
    while (!run.done()) run.step();
    EXPECT_NEAR(run.window.disparityOffset(), offset, 3.0 * run.window.disparityOffsetSigma());
    EXPECT_LT(run.window.disparityOffsetSigma(), 0.1);
  }
}

TEST(Window, ContinuesByPredictionWithoutObservations) {
  const auto tracks = simulateTracks(makeTracks(60, 0.5));
  TrackRunner run(tracks, WindowOptions());
  for (int i = 0; i < 20; ++i) run.step();
  double before = run.window.newest().covariance.trace();
  for (int i = 20; i < 40; ++i) {
    run.step([](const Observation&) { return false; });
    const auto newest = run.window.newest();
    ASSERT_TRUE(newest.pose.isFinite());
    ASSERT_EQ(newest.covariance.llt().info(), Eigen::Success);
    EXPECT_GT(newest.covariance.trace(), before) << i;
    before = newest.covariance.trace();
  }
  while (!run.done()) run.step();
  EXPECT_LT(poseNees(run.truth(), run.window.newest()), 40.0);
}

// The initial estimate of a pose is not a measurement of it.
TEST(Window, TakesAStartForNoEvidence) {
  const auto tracks = simulateTracks(makeTracks(40, 0.5));
  const Pose start = expSe3((Vector6d() << 0.4, -0.1, 0.6, 0.02, 0.1, -0.03).finished());
  for (const bool seen : {false, true}) {
    WindowOptions options;
    options.iterations = 20;
    TrackRunner plain(tracks, options), started(tracks, options);
    for (int i = 0; i < 20; ++i) plain.step(), started.step();
    ProcessInput u = plain.input(20);
    plain.window.addPose(20, u);
    u.T_from_start = start;
    started.window.addPose(20, u);
    ASSERT_FALSE(isApprox(plain.window.newest().pose, started.window.newest().pose, 0.1));
    for (TrackRunner* run : {&plain, &started}) {
      run->window.removePoses();
      if (seen)
        for (const Observation& observation : run->observations(20)) run->window.observe(observation);
      run->window.update();
    }
    EXPECT_TRUE(isApprox(plain.window.newest().pose, started.window.newest().pose, 1e-4)) << seen;
    EXPECT_TRUE(plain.window.newest().covariance.isApprox(started.window.newest().covariance, 1e-2)) << seen;
  }
}

TEST(Window, WithNeitherInputNorMeasurementStaysWithAProperCovariance) {
  const auto tracks = simulateTracks(makeTracks(3, 0.5));
  Window window(WindowOptions(), tracks.camera);
  window.start(0, Pose(), Matrix6d::Zero());
  for (FrameId frame = 1; frame < 30; ++frame) {
    window.addPose(frame, ProcessInput());
    window.removePoses();
    const UpdateReport report = window.update();
    EXPECT_EQ(report.observations, 0);
    ASSERT_TRUE(isApprox(window.newest().pose, Pose(), 1e-9));
    ASSERT_EQ(window.newest().covariance.llt().info(), Eigen::Success);
  }
}

TEST(Window, SurvivesNonsense) {
  const auto tracks = simulateTracks(makeTracks(60, 0.5));
  TrackRunner run(tracks, WindowOptions());
  std::uint64_t dice = 12345;
  const auto roll = [&] {
    return static_cast<double>((dice = dice * 6364136223846793005ULL + 1442695040888963407ULL) >> 33) / 2147483648.0;
  };
  while (!run.done()) {
    run.beginStep();
    const std::size_t i = run.at() + 1;
    for (Observation observation : run.observations(i)) {
      if (roll() < 0.4) observation.z = Eigen::Vector3d(600.0 * roll(), 400.0 * roll(), 600.0 * roll());
      if (roll() < 0.02) observation.z.x() = std::nan("");
      if (roll() < 0.1) observation.information.row(2).setZero(), observation.information.col(2).setZero();
      run.window.observe(observation);
    }
    run.endStep();
    const auto newest = run.window.newest();
    ASSERT_TRUE(newest.pose.isFinite()) << i;
    ASSERT_TRUE(newest.covariance.allFinite()) << i;
    ASSERT_EQ(newest.covariance.llt().info(), Eigen::Success) << i;
    for (const MapPoint& point : run.window.map()) ASSERT_TRUE(point.p_odom.allFinite());
  }
}

// Two interleaved recordings of different places: landmarks are measured alternately at two positions, and the motion
// of the camera is almost undetermined.
TEST(Window, StaysNearWhereMeasurementsContradictEachOther) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    urban_nav_core::testing::TrackOptions motion = makeTracks(80, 0.1, seed), other = makeTracks(80, 0.1, seed + 100);
    motion.features = other.features = 60;
    const auto here = simulateTracks(motion), there = simulateTracks(other);
    WindowOptions options;
    options.disparity_offset = 0.1;
    Window window(options, here.camera);
    window.start(0, Pose(), diagonalInformation(1e-3, 1e-4));
    for (std::size_t i = 1; i < here.frames.size(); ++i) {
      const auto frame = static_cast<FrameId>(i);
      ProcessInput u;
      u.information = diagonalInformation(30.0, 1.0);
      window.addPose(frame, u);
      window.removePoses();
      for (const auto& sighting : (i / 2 % 2 == 0 ? here : there).frames[i].sightings)
        window.observe({sighting.landmark, frame, sighting.z, pixelInformation(0.1)});
      window.update();
      const auto newest = window.newest();
      ASSERT_TRUE(newest.pose.isFinite()) << seed << ", " << i;
      ASSERT_LT(newest.pose.t().norm(), 1e5) << seed << ", " << i;
      ASSERT_TRUE(newest.covariance.allFinite()) << seed << ", " << i;
      ASSERT_LT(std::abs(window.disparityOffset()), 100.0) << seed << ", " << i;
    }
  }
}

TEST(Window, StartsALandmarkOnlyFromAFullMeasurement) {
  const auto tracks = simulateTracks(makeTracks(3, 0.5));
  Window window(WindowOptions(), tracks.camera);
  window.start(0, Pose(), diagonalInformation(1e-3, 1e-3));
  Observation observation;
  observation.landmark = 7;
  observation.z = Eigen::Vector3d(200.0, 100.0, 190.0);
  observation.information = pixelInformation(0.5);
  observation.information.row(2).setZero();
  observation.information.col(2).setZero();
  EXPECT_FALSE(window.observe(observation));
  observation.information = pixelInformation(0.5);
  EXPECT_TRUE(window.observe(observation));
  EXPECT_FALSE(window.observe(observation)) << "already measured in this frame";
  observation.frame = 5;
  EXPECT_FALSE(window.observe(observation)) << "no such frame";
  ASSERT_EQ(window.map().size(), 1U);
  const Eigen::Vector4d p = window.map()[0].p_odom;
  const auto z = tracks.camera.project(p.head<3>() / p.w());
  ASSERT_TRUE(z.has_value());
  EXPECT_LT((*z - observation.z).norm(), 1e-9);
}

TEST(Window, KnownLandmarksHoldThePose) {
  auto motion = makeTracks(60, 0.5);
  motion.missed = 0.0;
  const auto tracks = simulateTracks(motion);
  TrackRunner run(tracks, WindowOptions());
  run.first_information = diagonalInformation(1.0, 0.1);
  for (std::size_t m = 0; m < tracks.points.size(); ++m) {
    MapPoint point;
    point.landmark = static_cast<LandmarkId>(m);
    point.p_odom << tracks.points[m], 1.0;
    EXPECT_TRUE(run.window.fixLandmark(point));
  }
  double sum = 0.0;
  while (!run.done()) {
    run.step();
    sum += poseNees(run.truth(), run.window.newest());
  }
  EXPECT_LT(urban_nav_core::distanceBetween(run.window.newest().pose, run.truth()), 0.02);
  EXPECT_NEAR(sum / 60.0, 6.0, 2.0);
}

TEST(Window, AllocatesNothingInASteadyState) {
  if (!urban_nav_core::testing::countsAllocations()) GTEST_SKIP() << "the allocator of this build cannot be counted";
  const auto tracks = simulateTracks(makeTracks(260, 0.5));
  TrackRunner run(tracks, WindowOptions());
  run.settled.reserve(300);
  while (run.at() + 1 < 200) run.step();
  std::int64_t count = 0;
  while (!run.done()) {
    const auto observations = run.observations(run.at() + 1);
    const urban_nav_core::testing::AllocationCount allocations;
    run.beginStep();
    for (const Observation& observation : observations) run.window.observe(observation);
    run.endStep();
    count += allocations.sofar();
  }
  EXPECT_LE(count, 6) << "buffers may still grow once in a while";
}

}  // namespace
}  // namespace swf_vo
