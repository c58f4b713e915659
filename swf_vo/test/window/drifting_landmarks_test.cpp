// SPDX-License-Identifier: BSD-3-Clause
#include "window/drifting_landmarks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "track_runner.hpp"
#include "urban_nav_core/testing/tracks.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::testing::simulateTracks;
using urban_nav_core::testing::TrackOptions;

constexpr double kSigmaPx = 0.1;

TrackOptions sixtyFeatures(std::uint64_t seed) {
  TrackOptions options;
  options.frames = 60;
  options.features = 60;
  options.sigma_px = kSigmaPx;
  options.seed = seed;
  return options;
}

/// Runs to the end; `slide` gives the displacement of a landmark in a frame (px). Returns how often each landmark was
/// found to drift.
template <typename Slide>
std::map<LandmarkId, int> driftingLandmarks(const urban_nav_core::testing::Tracks& tracks, const Slide& slide) {
  TrackRunner run(tracks, WindowOptions());
  std::map<LandmarkId, int> found;
  for (std::size_t i = 0; i < tracks.frames.size(); ++i) {
    run.beginStep();
    for (Observation observation : run.observations(i)) {
      observation.sigma_px = kSigmaPx;
      const double by = slide(observation.landmark, i);
      observation.z += Eigen::Vector3d(by, 0.0, by);
      run.window.observe(observation);
    }
    run.endStep();
    for (const LandmarkId landmark : run.window.driftingLandmarks()) ++found[landmark];
  }
  return found;
}

// Three landmarks drift by less per frame than the standard deviation of a measurement.
TEST(DriftingLandmarks, FindsWhatSlidesSlowly) {
  const auto tracks = simulateTracks(sixtyFeatures(3));
  const auto sliding = [](LandmarkId landmark) { return landmark < 30 && landmark % 10 == 0; };
  const auto found = driftingLandmarks(tracks, [&](LandmarkId landmark, std::size_t i) {
    return sliding(landmark) ? 0.8 * kSigmaPx * static_cast<double>(i) : 0.0;
  });
  for (const LandmarkId landmark : {0, 10, 20}) {
    std::size_t seen = 0;
    for (const auto& frame : tracks.frames)
      seen +=
          static_cast<std::size_t>(std::count_if(frame.sightings.begin(), frame.sightings.end(),
                                                 [&](const auto& sighting) { return sighting.landmark == landmark; }));
    if (seen < 10) continue;
    EXPECT_GT(found.count(landmark), 0U) << landmark << ", seen " << seen << " times";
  }
}

TEST(DriftingLandmarks, LeavesWhatKeepsStillAlone) {
  std::size_t called = 0, landmarks = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto tracks = simulateTracks(sixtyFeatures(seed));
    called += driftingLandmarks(tracks, [](LandmarkId, std::size_t) { return 0.0; }).size();
    landmarks += tracks.points.size();
  }
  EXPECT_LT(called, landmarks / 50);
}

TEST(DriftingLandmarks, TestsNothingWithoutTheAlignmentCovariance) {
  const auto tracks = simulateTracks(sixtyFeatures(5));
  TrackRunner run(tracks, WindowOptions());
  while (!run.done()) {
    run.step();
    EXPECT_TRUE(run.window.driftingLandmarks().empty());
  }
}

}  // namespace
}  // namespace swf_vo
