// SPDX-License-Identifier: BSD-3-Clause
// A shaken handheld camera at a low frame rate: the velocities of successive steps are hardly correlated.
#include <gtest/gtest.h>

#include "recordings.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Pose;

constexpr double kShakeDegree = M_PI / 180.0;

struct Shaking {
  double step_deg;  ///< largest angle between two frames
  double exposure;  ///< s
};

class Shaken : public ::testing::TestWithParam<Shaking> {};

TEST_P(Shaken, EndsWithinAPerCentOfThePath) {
  constexpr double kRate = 5.0, kHz = 0.7;
  urban_nav_core::testing::SequenceOptions options;
  options.camera = roomCamera();
  options.rate = kRate;
  options.exposure = GetParam().exposure;
  const double angle = GetParam().step_deg * kShakeDegree * kRate / (2.0 * M_PI * kHz);
  urban_nav_core::testing::RenderedSequence sequence(urban_nav_core::testing::texturedRoom(),
                                                     urban_nav_core::testing::shake({0.0, 0.0, 1.1}, 0.15, angle, kHz),
                                                     options);
  const Recording recording = record(sequence, 50);
  SwfVo filter(Parameters(), recording.camera, Pose());
  double path = 0.0, error = 0.0;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const Frame& frame = filter.process(recording.frames[i].pair(), {});
    expectProper(frame);
    error = distanceBetween(recording.truth[i], frame.T_odom_base.pose);
    if (i > 0) path += distanceBetween(recording.truth[i - 1], recording.truth[i]);
  }
  EXPECT_LT(error, 0.01 * path) << path << " m";
}

INSTANTIATE_TEST_SUITE_P(FewFrames, Shaken, ::testing::Values(Shaking{10.0, 0.0}, Shaking{10.0, 0.02}));

}  // namespace
}  // namespace swf_vo
