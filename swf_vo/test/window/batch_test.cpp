// SPDX-License-Identifier: BSD-3-Clause
// A window of at least the number of frames is the batch solution, robust kernel included.
#include <gtest/gtest.h>

#include "window/batch_ceres.hpp"
#include "window/track_runner.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::isApprox;

TEST(Window, LongerThanTheRunEqualsTheBatch) {
  urban_nav_core::testing::TrackOptions motion;
  motion.seed = 3;
  motion.frames = 15;
  motion.features = 25;
  motion.sigma_px = 0.5;
  motion.motion = urban_nav_core::testing::TrackMotion::Mixed;
  motion.farthest = 15.0;
  const auto tracks = simulateTracks(motion);
  WindowOptions options;
  options.size = 20;
  options.huber = 1.0;  // a fifth of all measurements are beyond; gross outliers would create several minima
  options.iterations = 100;
  options.tolerance = 1e-18;
  TrackRunner run(tracks, options);
  BatchProblem batch;
  batch.camera = tracks.camera;
  batch.first_information = run.first_information;
  batch.huber = options.huber;
  batch.points = tracks.points;
  UpdateReport report;
  for (std::size_t i = 0; i < tracks.frames.size(); ++i) {
    batch.poses.push_back(tracks.frames[i].T_world_camera);
    batch.inputs.push_back(i > 0 ? run.input(i) : ProcessInput());
    for (const Observation& observation : run.observations(i)) batch.observations.push_back(observation);
    report = run.step();
  }
  EXPECT_GT(report.downweighted, 10) << "the robust kernel has to have something to do";
  ASSERT_TRUE(solveBatch(batch));
  for (std::size_t i = 0; i < tracks.frames.size(); ++i)
    EXPECT_TRUE(isApprox(run.window.pose(static_cast<FrameId>(i)), batch.poses[i], 1e-6))
        << i << ": " << run.window.pose(static_cast<FrameId>(i)) << " / " << batch.poses[i];
}

}  // namespace
}  // namespace swf_vo
