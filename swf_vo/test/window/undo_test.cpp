// SPDX-License-Identifier: BSD-3-Clause
// A withdrawn or late measurement gives the filter that never had it, or had it in time (section 2.2.1).
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "window/track_runner.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Matrix6d;

constexpr std::size_t kTouchedFrame = 14, kChangeFrame = 18, kLastFrame = 24;
constexpr std::size_t kSlidesFrom = 10, kFirstUndone = 12;  // from then on, each of six frames can be undone
constexpr double kPxAFrame = 0.4;

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

// Returns a landmark, different from `but`, that was measured before and after the touched frame.
LandmarkId victim(const urban_nav_core::testing::Tracks& tracks, std::size_t touched = kTouchedFrame,
                  LandmarkId but = -1) {
  for (const auto& sighting : tracks.frames[touched].sightings) {
    int seen = 0;
    for (std::size_t i = touched - 2; i < touched + 3; ++i)
      for (const auto& other : tracks.frames[i].sightings) seen += other.landmark == sighting.landmark;
    if (seen == 5 && sighting.landmark != but) return sighting.landmark;
  }
  return -1;
}

void expectSame(const Window& a, const Window& b, double tolerance) {
  for (std::size_t i = kLastFrame - 5; i <= kLastFrame; ++i) {
    const FrameId frame = static_cast<FrameId>(i);
    ASSERT_TRUE(a.hasPose(frame) && b.hasPose(frame));
    EXPECT_TRUE(urban_nav_core::isApprox(a.pose(frame), b.pose(frame), tolerance)) << i;
  }
  const Matrix6d P = a.newest().covariance, Q = b.newest().covariance;
  EXPECT_LT((P - Q).cwiseAbs().maxCoeff(), tolerance * P.cwiseAbs().maxCoeff());
}

TEST(Undo, WithdrawnMeasurementLeavesNoTrace) {
  const auto tracks = someTracks();
  const LandmarkId landmark = victim(tracks);
  ASSERT_GE(landmark, 0);
  const auto without = [&](const Observation& o) {
    return o.landmark != landmark || o.frame != static_cast<FrameId>(kTouchedFrame);
  };
  TrackRunner had(tracks, sixPoses()), never(tracks, sixPoses()), always(tracks, sixPoses());
  for (std::size_t i = 0; i <= kLastFrame; ++i) {
    if (i == kChangeFrame) {
      EXPECT_TRUE(had.window.withdraw(landmark, static_cast<FrameId>(kTouchedFrame)));
    }
    had.step();
    never.step(without);
    always.step();
  }
  expectSame(had.window, never.window, 1e-9);
  EXPECT_FALSE(urban_nav_core::isApprox(always.window.newest().pose, never.window.newest().pose, 1e-7))
      << "it made no difference";
}

TEST(Undo, LateMeasurementCountsAsIfInTime) {
  const auto tracks = someTracks();
  const LandmarkId landmark = victim(tracks);
  Observation late;
  const auto without = [&](const Observation& o) {
    if (o.landmark != landmark || o.frame != static_cast<FrameId>(kTouchedFrame)) return true;
    late = o;
    return false;
  };
  TrackRunner had(tracks, sixPoses()), always(tracks, sixPoses());
  for (std::size_t i = 0; i <= kLastFrame; ++i) {
    if (i == kChangeFrame) {
      EXPECT_TRUE(had.window.observe(late));
    }
    had.step(without);
    always.step();
  }
  expectSame(had.window, always.window, 1e-9);
}

TEST(Undo, ALandmarkTakenBackInTheMiddleOfAStepIsGone) {
  const auto tracks = someTracks();
  const LandmarkId landmark = victim(tracks);
  TrackRunner had(tracks, sixPoses()), never(tracks, sixPoses());
  // Limited by the window: earlier marginalised terms are not changed.
  const FrameId oldest = static_cast<FrameId>(kTouchedFrame + 3) - 5;
  const auto before = [&](const Observation& o) { return o.landmark != landmark || o.frame < oldest; };
  for (std::size_t i = 0; i <= kLastFrame; ++i) {
    had.beginStep();
    for (const Observation& observation : had.observations(i))
      if (i <= kTouchedFrame + 3 || observation.landmark != landmark) had.window.observe(observation);
    if (i == kTouchedFrame + 3) had.window.withdrawAll(landmark);
    had.endStep();
    never.step(before);
  }
  expectSame(had.window, never.window, 1e-9);
}

/// Tracks in which one landmark drifts over its surface; the window drops driftingLandmarks() after each update, as in
/// SwfVo.
class Sliding {
 public:
  using Wanted = std::function<bool(const Observation&)>;
  using GivenUp = std::map<LandmarkId, std::size_t>;  ///< after the update of which frame

  Sliding(const urban_nav_core::testing::Tracks& tracks, LandmarkId slides)
      : sigma_px_(tracks.sigma_px), slides_(slides), run_(tracks, sixPoses()) {}

  void step(const Wanted& wanted) {
    observe(wanted);
    if (run_.at() < kFirstUndone) return;
    for (const LandmarkId landmark : run_.window.driftingLandmarks()) {
      given_up[landmark] = run_.at();
      run_.window.withdrawAll(landmark);
      run_.window.endLandmark(landmark);
    }
  }

  /// The same step without landmarks that another window dropped: no measurements in frames of the window at that time,
  /// nor later.
  void stepWithout(const GivenUp& others, const Wanted& wanted) {
    observe([&](const Observation& o) {
      const auto at = others.find(o.landmark);
      return wanted(o) && (at == others.end() || o.frame + 5 < static_cast<FrameId>(at->second));
    });
    for (const auto& [landmark, frame] : others)
      if (frame == run_.at()) run_.window.endLandmark(landmark);
  }

  Window& window() { return run_.window; }

  GivenUp given_up;

 private:
  void observe(const Wanted& wanted) {
    run_.beginStep();
    for (Observation observation : run_.observations(next_)) {
      observation.sigma_px = sigma_px_;
      const double by = observation.landmark == slides_ && next_ > kSlidesFrom
                            ? kPxAFrame * static_cast<double>(next_ - kSlidesFrom)
                            : 0.0;
      observation.z += Eigen::Vector3d(by, 0.0, by);
      if (given_up.count(observation.landmark) == 0 && wanted(observation)) run_.window.observe(observation);
    }
    run_.endStep();
    ++next_;
  }

  double sigma_px_;
  LandmarkId slides_;
  TrackRunner run_;
  std::size_t next_ = 0;
};

urban_nav_core::testing::Tracks manyTracks() {
  urban_nav_core::testing::TrackOptions motion;
  motion.seed = 5;
  motion.frames = 30;
  motion.sigma_px = 0.1;
  return simulateTracks(motion);
}

bool everything(const Observation&) { return true; }

TEST(Undo, StrayLeavesNoTraceInTheWindow) {
  const auto tracks = manyTracks();
  const LandmarkId stray = victim(tracks);
  Sliding had(tracks, stray), never(tracks, stray);
  for (std::size_t i = 0; i <= kLastFrame; ++i) had.step(everything);
  ASSERT_EQ(had.given_up.count(stray), 1U);
  for (std::size_t i = 0; i <= kLastFrame; ++i) never.stepWithout(had.given_up, everything);
  expectSame(had.window(), never.window(), 1e-9);
}

// The repeated steps include that after which the drifting landmark was dropped.
TEST(Undo, WithdrawnAndLateMeasurementsCountRightAroundAStray) {
  const auto tracks = manyTracks();
  const LandmarkId stray = victim(tracks);
  Sliding always(tracks, stray);
  for (std::size_t i = 0; i <= kLastFrame; ++i) always.step(everything);
  ASSERT_EQ(always.given_up.count(stray), 1U);
  const std::size_t given_up = always.given_up[stray], touched = given_up - 2, change = given_up + 2;
  const LandmarkId landmark = victim(tracks, touched, stray);
  ASSERT_GE(landmark, 0);

  Observation late;
  const auto without = [&](const Observation& o) {
    if (o.landmark != landmark || o.frame != static_cast<FrameId>(touched)) return true;
    late = o;
    return false;
  };
  Sliding withdrawn(tracks, stray), inserted(tracks, stray), never(tracks, stray);
  for (std::size_t i = 0; i <= kLastFrame; ++i) {
    if (i == change) {
      EXPECT_TRUE(withdrawn.window().withdraw(landmark, static_cast<FrameId>(touched)));
      EXPECT_TRUE(inserted.window().observe(late));
    }
    withdrawn.step(everything);
    inserted.step(without);
    never.step(without);
  }
  for (const Sliding* run : {&withdrawn, &inserted, &never}) ASSERT_EQ(run->given_up, always.given_up);
  expectSame(withdrawn.window(), never.window(), 1e-9);
  expectSame(inserted.window(), always.window(), 1e-9);
  EXPECT_FALSE(urban_nav_core::isApprox(always.window().newest().pose, never.window().newest().pose, 1e-7))
      << "it made no difference";
}

TEST(Undo, RefusesWhatLeftTheWindow) {
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
