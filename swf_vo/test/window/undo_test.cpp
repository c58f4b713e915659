// SPDX-License-Identifier: BSD-3-Clause
// A measurement that is withdrawn or comes late leaves the filter that never had it, or had it in time (section 2.2.1).
#include <gtest/gtest.h>

#include "window/track_runner.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Matrix6d;

constexpr std::size_t touched_frame = 14, change_frame = 18, last_frame = 24;

urban_nav_core::testing::Tracks someTracks() {
  urban_nav_core::testing::TrackOptions motion;
  motion.seed = 5;
  motion.frames = 30;
  motion.features = 14;
  motion.track_length = 8.0;
  motion.sigma_px = 0.5;
  motion.outliers = 0.05;
  return simulateTracks(motion);
}

WindowOptions sixPoses() {
  WindowOptions options;
  options.size = 6;
  return options;
}

// A landmark that was seen before and after the touched frame.
LandmarkId victim(const urban_nav_core::testing::Tracks& tracks) {
  for (const auto& sighting : tracks.frames[touched_frame].sightings) {
    int seen = 0;
    for (std::size_t i = touched_frame - 2; i < touched_frame + 3; ++i)
      for (const auto& other : tracks.frames[i].sightings) seen += other.landmark == sighting.landmark;
    if (seen == 5) return sighting.landmark;
  }
  return -1;
}

void expectSame(const Window& a, const Window& b, double tolerance) {
  for (std::size_t i = last_frame - 5; i <= last_frame; ++i) {
    const FrameId frame = static_cast<FrameId>(i);
    ASSERT_TRUE(a.hasPose(frame) && b.hasPose(frame));
    EXPECT_TRUE(urban_nav_core::isApprox(a.pose(frame), b.pose(frame), tolerance)) << i;
  }
  const Matrix6d P = a.newest().covariance, Q = b.newest().covariance;
  EXPECT_LT((P - Q).cwiseAbs().maxCoeff(), tolerance * P.cwiseAbs().maxCoeff());
}

TEST(Undo, withdrawnMeasurementLeavesNoTrace) {
  const auto tracks = someTracks();
  const LandmarkId landmark = victim(tracks);
  ASSERT_GE(landmark, 0);
  const auto without = [&](const Observation& o) {
    return o.landmark != landmark || o.frame != static_cast<FrameId>(touched_frame);
  };
  TrackRunner had(tracks, sixPoses()), never(tracks, sixPoses()), always(tracks, sixPoses());
  for (std::size_t i = 0; i <= last_frame; ++i) {
    if (i == change_frame) {
      EXPECT_TRUE(had.window.withdraw(landmark, static_cast<FrameId>(touched_frame)));
    }
    had.step();
    never.step(without);
    always.step();
  }
  expectSame(had.window, never.window, 1e-9);
  EXPECT_FALSE(urban_nav_core::isApprox(always.window.newest().pose, never.window.newest().pose, 1e-7))
      << "it made no difference";
}

TEST(Undo, lateMeasurementCountsAsIfInTime) {
  const auto tracks = someTracks();
  const LandmarkId landmark = victim(tracks);
  Observation late;
  const auto without = [&](const Observation& o) {
    if (o.landmark != landmark || o.frame != static_cast<FrameId>(touched_frame)) return true;
    late = o;
    return false;
  };
  TrackRunner had(tracks, sixPoses()), always(tracks, sixPoses());
  for (std::size_t i = 0; i <= last_frame; ++i) {
    if (i == change_frame) {
      EXPECT_TRUE(had.window.observe(late));
    }
    had.step(without);
    always.step();
  }
  expectSame(had.window, always.window, 1e-9);
}

TEST(Undo, aLandmarkTakenBackInTheMiddleOfAStepIsGone) {
  const auto tracks = someTracks();
  const LandmarkId landmark = victim(tracks);
  TrackRunner had(tracks, sixPoses()), never(tracks, sixPoses());
  // As far back as the window reaches: what was marginalised earlier stays.
  const FrameId oldest = static_cast<FrameId>(touched_frame + 3) - 5;
  const auto before = [&](const Observation& o) { return o.landmark != landmark || o.frame < oldest; };
  for (std::size_t i = 0; i <= last_frame; ++i) {
    had.beginStep();
    for (const Observation& observation : had.observations(i))
      if (i <= touched_frame + 3 || observation.landmark != landmark) had.window.observe(observation);
    if (i == touched_frame + 3) had.window.withdrawAll(landmark);
    had.endStep();
    never.step(before);
  }
  expectSame(had.window, never.window, 1e-9);
}

TEST(Undo, refusesWhatLeftTheWindow) {
  const auto tracks = someTracks();
  TrackRunner run(tracks, sixPoses());
  for (std::size_t i = 0; i < 12; ++i) run.step();
  const LandmarkId landmark = tracks.frames[3].sightings[0].landmark;
  EXPECT_FALSE(run.window.withdraw(landmark, 3));
  EXPECT_FALSE(run.window.withdraw(123456, 11));
  Observation late;
  late.landmark = 99999;
  late.frame = 2;
  late.z = Eigen::Vector3d(200.0, 200.0, 190.0);
  late.information = pixelInformation(0.5);
  EXPECT_FALSE(run.window.observe(late));
}

}  // namespace
}  // namespace swf_vo
