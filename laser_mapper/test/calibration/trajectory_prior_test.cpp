// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/trajectory_prior.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/geometry/dense.hpp"

namespace laser_mapper {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;

/// Along x at 1 m/s.
Trajectory straightOn() {
  Trajectory trajectory;
  for (int i = 0; i <= 100; ++i)
    trajectory.append(1'000'000'000 + static_cast<urban_nav_core::StampNs>(i) * 50'000'000,
                      Pose(Eigen::Quaterniond::Identity(), Vector3d(0.05 * i, 0.0, 0.0)));
  return trajectory;
}

TEST(TrajectoryPrior, UncertaintyOfHeadingBecomesUncertaintyAside) {
  const TrajectoryPrior prior(straightOn(), nullptr, 1'000'000'000, 5);
  ASSERT_EQ(prior.count(), 5U);
  MatrixXd information = MatrixXd::Zero(30, 30);
  VectorXd gradient = VectorXd::Zero(30);
  prior.addTo(std::vector<PoseCorrection>(5, PoseCorrection::Zero()), information, gradient);
  EXPECT_EQ(gradient.norm(), 0.0);
  urban_nav_core::mirrorLowerInPlace(information);
  EXPECT_NEAR((prior.transformed(MatrixXd::Identity(30, 30)) - information).norm(), 0.0, 1e-9 * information.norm());
  const auto covariance = urban_nav_core::invertPositiveDefinite(information);
  ASSERT_TRUE(covariance);
  const double step = 1e-3, turn = 3e-4;
  EXPECT_NEAR((*covariance)(29, 29), 4.0 * turn * turn, 1e-9);                              // heading after 4 s
  EXPECT_NEAR((*covariance)(24, 24), 4.0 * step * step, 1e-9);                              // along
  EXPECT_NEAR((*covariance)(25, 25), 4.0 * step * step + (9 + 4 + 1) * turn * turn, 1e-9);  // aside
}

TEST(TrajectoryPrior, PullsCorrectionsBack) {
  const TrajectoryPrior prior(straightOn(), nullptr, 1'000'000'000, 3);
  std::vector<PoseCorrection> corrections(3, PoseCorrection::Zero());
  corrections[2] << 0.01, 0.0, 0.0, 0.0, 0.0, 0.001;
  MatrixXd information = MatrixXd::Zero(18, 18);
  VectorXd gradient = VectorXd::Zero(18);
  prior.addTo(corrections, information, gradient);
  ASSERT_TRUE(urban_nav_core::solvePositiveDefiniteInPlace(information, gradient));
  EXPECT_NEAR(gradient(12), -0.01, 1e-9);
  EXPECT_NEAR(gradient(17), -0.001, 1e-9);
}

}  // namespace
}  // namespace laser_mapper
