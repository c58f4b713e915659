// SPDX-License-Identifier: BSD-3-Clause
// At window 1, with one iteration and no robust kernel, the filter equals the extended Kalman filter (section 2.2.1).
#include <gtest/gtest.h>

#include "window/ekf_reference.hpp"
#include "window/track_runner.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Matrix6d;

class WindowOne : public ::testing::TestWithParam<bool> {};

TEST_P(WindowOne, EqualsTheExtendedKalmanFilter) {
  auto motion = mixedMotion(50, 0.5, 7);
  motion.features = 15;
  motion.track_length = 6.0;
  motion.missed = 0.2;
  const auto tracks = urban_nav_core::testing::simulateTracks(motion);
  WindowOptions options;
  options.size = 1;
  options.iterations = 1;
  options.huber = 0.0;
  options.linearise_first = GetParam();
  TrackRunner run(tracks, options);
  EkfReference ekf(tracks.camera, GetParam());
  int moved = 0;
  for (std::size_t i = 0; i < tracks.frames.size(); ++i) {
    if (i == 0) ekf.start(tracks.frames[0].T_world_camera, run.first_information.inverse());
    else ekf.propagate(run.input(i));
    if (i > 0)
      for (const auto ended : tracks.frames[i - 1].ended) ekf.forget(ended);
    ekf.update(run.observations(i));
    run.step();
    const auto newest = run.window.newest();
    EXPECT_TRUE(urban_nav_core::isApprox(newest.pose, ekf.pose, 1e-8))
        << "frame " << i << ": " << newest.pose << " / " << ekf.pose;
    const Matrix6d P = ekf.covariance();
    const urban_nav_core::Vector6d scale = P.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix6d difference = scale.asDiagonal() * (newest.covariance - P) * scale.asDiagonal();
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-8) << "frame " << i;
    moved += urban_nav_core::distanceBetween(newest.pose, run.truth()) > 1e-5;
  }
  EXPECT_GT(moved, 40) << "without errors the comparison is not significant";
}

INSTANTIATE_TEST_SUITE_P(Linearised, WindowOne, ::testing::Bool(),
                         [](const auto& parameter) { return parameter.param ? "first" : "latest"; });

}  // namespace
}  // namespace swf_vo
