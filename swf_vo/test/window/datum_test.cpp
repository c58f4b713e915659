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

TEST(Datum, ReplacingTheDatumChangesNothing) {
  // With such small noise the problem is linear, and only the algebra is tested.
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

// Mean normalised squared error of compositions of `length` steps, over a few runs.
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
  // Not contained in the part that accumulates independently over steps.
  EXPECT_EQ(a.settled.back().drift_covariance, b.settled.back().drift_covariance);
  EXPECT_NEAR(b.window.scaleSigma(), off.rig_scale, 1e-12);
  // Each step states its sensitivity.
  EXPECT_TRUE(a.settled.back().constants.empty());
  for (std::size_t i = 1; i < b.settled.size(); ++i) {
    ASSERT_EQ(b.settled[i].constants.size(), 1U);
    const urban_nav_core::ConsideredConstant& scale = b.settled[i].constants.front();
    EXPECT_EQ(scale.name, "scale");
    EXPECT_EQ(scale.sigma, off.rig_scale);
    EXPECT_EQ(scale.sensitivity.head<3>(), b.settled[i].T_previous_camera.t());
    EXPECT_EQ(scale.sensitivity.tail<3>(), Eigen::Vector3d::Zero());
  }
}

// Settled poses with the disparity offset fixed at this distance from the true one, px.
std::vector<SettledPose> settledWithOffset(double offset) {
  auto tracks = turning(120, 1e-3);
  tracks.camera.disparity_offset += offset;
  WindowOptions options;
  options.disparity_offset = 1e-7;
  TrackRunner run(tracks, options);
  while (!run.done()) run.step();
  return run.settled;
}

TEST(Datum, SensitivitiesOfStepsAddUpToThatOfThePath) {
  constexpr double kOff = 1e-3;  // px
  const std::vector<SettledPose> more = settledWithOffset(kOff), less = settledWithOffset(-kOff),
                                 at = settledWithOffset(0.0);
  ASSERT_EQ(more.size(), at.size());
  Pose path_pose;
  Vector6d summed = Vector6d::Zero();
  constexpr std::size_t kFirst = 10;
  for (std::size_t i = kFirst + 1; i < at.size(); ++i) {
    ASSERT_EQ(at[i].constants.size(), 1U);
    EXPECT_EQ(at[i].constants.front().name, "disparity");
    const auto step = urban_nav_core::compose(path_pose, at[i].T_previous_camera);
    summed = step.J1 * summed + step.J2 * at[i].constants.front().sensitivity;
    path_pose = step.T_a_c;
  }
  const auto path = [&](const std::vector<SettledPose>& of) {
    return of[kFirst].T_odom_camera.pose.inverse() * of.back().T_odom_camera.pose;
  };
  const Vector6d moved = urban_nav_core::boxMinus(path(more), path(less)) / (2.0 * kOff);
  EXPECT_GT(moved.head<3>().norm(), 0.0);
  EXPECT_LT((moved - summed).head<3>().norm(), 0.1 * moved.head<3>().norm()) << moved.transpose() << "\n"
                                                                             << summed.transpose();
}

}  // namespace
}  // namespace swf_vo
