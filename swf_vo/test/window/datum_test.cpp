// SPDX-License-Identifier: BSD-3-Clause
#include "window/datum.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "urban_nav_core/geometry/compose.hpp"
#include "window/filter.hpp"
#include "window/track_runner.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::Vector6d;

urban_nav_core::testing::Tracks turning(int frames, double sigma_px, std::uint64_t seed = 8) {
  return simulateTracks(mixedMotion(frames, sigma_px, seed));
}

double largestDifference(const Matrix6d& P, const Matrix6d& Q) {
  const Vector6d scale = P.diagonal().cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * (P - Q) * scale.asDiagonal()).cwiseAbs().maxCoeff();
}

TEST(Datum, HeldAnewChangesNothing) {
  // Noise so small that the world is linear: all that is left is algebra.
  const auto tracks = turning(130, 1e-3);
  WindowOptions often, never;
  often.iterations = never.iterations = 20;
  often.tolerance = never.tolerance = 1e-14;
  often.datum_ratio = 1.0;
  never.datum_ratio = 1e300;
  TrackRunner a(tracks, often), b(tracks, never);
  a.first_information = b.first_information = diagonalInformation(1e-3, 1e-4);
  while (!a.done()) {
    a.step();
    b.step();
    EXPECT_TRUE(urban_nav_core::isApprox(a.window.newest().pose, b.window.newest().pose, 1e-7)) << a.at();
    EXPECT_LT(largestDifference(a.window.newest().covariance, b.window.newest().covariance), 1e-3) << a.at();
  }
  ASSERT_EQ(a.settled.size(), b.settled.size());
  for (std::size_t i = 1; i < a.settled.size(); ++i) {
    EXPECT_LT(largestDifference(a.settled[i].T_odom_camera.covariance, b.settled[i].T_odom_camera.covariance), 1e-3)
        << i;
    EXPECT_LT(largestDifference(a.settled[i].relative_covariance, b.settled[i].relative_covariance), 2e-2) << i;
    EXPECT_LT(largestDifference(a.settled[i].drift_covariance, b.settled[i].drift_covariance), 2e-2) << i;
  }
}

TEST(Datum, GivesProperCovariancesHeldAtEachStep) {
  const auto tracks = turning(60, 0.5);
  WindowOptions options;
  options.datum_ratio = 1.0;
  Filter filter(options, tracks.camera);
  TrackRunner inputs(tracks, options);
  std::vector<SettledPose> settled;
  for (std::size_t i = 0; i < tracks.frames.size(); ++i) {
    if (i == 0) filter.start(0, tracks.frames[0].T_world_camera, inputs.first_information);
    else filter.addPose(static_cast<FrameId>(i), inputs.input(i));
    filter.removePoses(settled, nullptr);
    for (const Observation& observation : inputs.observations(i)) filter.observe(observation);
    for (const auto ended : tracks.frames[i].ended) filter.endLandmark(ended);
    filter.update();
  }
  ASSERT_TRUE(filter.datum().isActive());
  for (std::size_t i = 1; i < settled.size(); ++i) {
    EXPECT_EQ(settled[i].relative_covariance.llt().info(), Eigen::Success) << i;
    EXPECT_EQ(settled[i].drift_covariance.llt().info(), Eigen::Success) << i;
  }
}

// Mean of the normalised squared error of composed ways of `length` steps, over a few runs.
double meanNees(std::size_t length, urban_nav_core::testing::TrackMotion kind) {
  double sum = 0.0;
  int ways = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    urban_nav_core::testing::TrackOptions motion;
    motion.seed = 70 + seed;
    motion.frames = 190;
    motion.features = 25;
    motion.motion = kind;
    const auto tracks = simulateTracks(motion);
    TrackRunner run(tracks, WindowOptions());
    while (!run.done()) run.step();
    for (std::size_t first = 2; first + length < run.settled.size();
         first += std::max<std::size_t>(1, length / 2), ++ways) {
      PoseWithCovariance way{Pose(), Matrix6d::Zero()};
      for (std::size_t i = first + 1; i <= first + length; ++i) {
        const SettledPose& step = run.settled[i];
        const double ends = (i == first + 1 ? 0.5 : 0.0) + (i == first + length ? 0.5 : 0.0);
        way = urban_nav_core::compose(
            way, PoseWithCovariance{step.T_previous_camera,
                                    length == 1 ? step.relative_covariance
                                                : Matrix6d(step.drift_covariance + ends * step.relative_covariance)});
      }
      const Vector6d e = urban_nav_core::boxMinus(
          tracks.frames[first].T_world_camera.inverse() * tracks.frames[first + length].T_world_camera, way.pose);
      sum += e.dot(way.covariance.ldlt().solve(e));
    }
  }
  return sum / ways;
}

TEST(Datum, DriftAddsUpOverAnyNumberOfSteps) {
  using urban_nav_core::testing::TrackMotion;
  for (const TrackMotion kind : {TrackMotion::Mixed, TrackMotion::Standing}) {
    EXPECT_NEAR(meanNees(1, kind), 6.0, 0.7);
    EXPECT_NEAR(meanNees(10, kind), 6.0, 1.2);
    EXPECT_NEAR(meanNees(50, kind), 6.0, 2.4);
  }
}

TEST(Datum, TheRigsScaleIsOneErrorOfTheWholePath) {
  const auto tracks = turning(60, 0.5);
  WindowOptions exact, off;
  off.rig_scale = 0.02;
  TrackRunner a(tracks, exact), b(tracks, off);
  while (!a.done()) {
    a.step();
    b.step();
    ASSERT_EQ(a.window.newest().pose.t(), b.window.newest().pose.t()) << a.at();
  }
  ASSERT_EQ(a.settled.size(), b.settled.size());
  const Eigen::Vector3d path = a.settled.back().T_odom_camera.pose.t() - a.settled.front().T_odom_camera.pose.t();
  const Matrix6d added = b.settled.back().T_odom_camera.covariance - a.settled.back().T_odom_camera.covariance;
  Matrix6d expected = Matrix6d::Zero();
  expected.topLeftCorner<3, 3>() = off.rig_scale * off.rig_scale * path * path.transpose();
  EXPECT_LT((added - expected).norm(), 0.05 * expected.norm()) << "but for where the first pose was taken to be";
  // What adds up over steps as if independent does not have it.
  EXPECT_EQ(a.settled.back().drift_covariance, b.settled.back().drift_covariance);
  EXPECT_NEAR(b.window.scaleSigma(), off.rig_scale, 1e-12);
}

}  // namespace
}  // namespace swf_vo
