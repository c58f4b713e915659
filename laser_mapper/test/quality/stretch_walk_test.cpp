// SPDX-License-Identifier: BSD-3-Clause
#include "quality/stretch_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/drifting_pass.hpp"

namespace laser_mapper {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing_drift::DriftingPass;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

constexpr StampNs kWalkBegin = 1'225'719'872'000'000'000;
constexpr std::size_t kWalkReference = 100;  // pose in the middle of the 4 s
const PlaneAxes kGroundAxes{Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitY()};
const PlaneAxes kWallAxes{-Vector3d::UnitY(), Vector3d::UnitZ(), -Vector3d::UnitX()};

StretchWalk walkAlong(const DriftingPass& pass) {
  return StretchWalk(pass.mapped, pass.mapped[kWalkReference].stamp, kWalkBegin, pass.mapped.back().stamp, &pass.drift);
}

/// Returns the covariance of a patch's displacement and rotations relative to the reference pose, over many walks.
Matrix3d sampleCovariance(const Matrix6d& rate, const Vector3d& p, const PlaneAxes& axes, int trials) {
  std::mt19937 random(11);
  Matrix3d covariance = Matrix3d::Zero();
  for (int i = 0; i < trials; ++i) {
    const DriftingPass pass(kWalkBegin, rate, random);
    const PlanePatch patch = pass.see(p, axes.normal);
    const Pose T_true_map = pass.truth[kWalkReference].pose * pass.mapped[kWalkReference].pose.inverse();
    const Vector3d turn = axes.normal.cross(T_true_map.q() * patch.normal);
    const Vector3d error(axes.normal.dot(T_true_map * patch.centre - p), axes.first.dot(turn), axes.second.dot(turn));
    covariance += error * error.transpose() / trials;
  }
  return covariance;
}

/// Expects two covariances to be equal up to the sampling error of `trials` samples, the discretisation of the walk,
/// and second-order terms.
void expectSameCovariance(const Matrix3d& sampled, const Matrix3d& stated, int trials) {
  const double limit = 4.0 * std::sqrt(2.0 / trials) + 0.06;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(sampled(i, j), stated(i, j), limit * std::sqrt(stated(i, i) * stated(j, j)) + 1e-9) << i << ' ' << j;
}

void expectStated(const Matrix6d& rate, const Vector3d& p, const PlaneAxes& axes) {
  constexpr int kTrials = 1500;
  std::mt19937 random(3);
  const DriftingPass exact(kWalkBegin, 1e-12 * rate, random);
  DriftingPass pass = exact;
  std::mt19937 other(4);
  pass.drift = DriftingPass(kWalkBegin, rate, other).drift;
  const Eigen::MatrixXd rows = walkAlong(pass).rows(exact.see(p, axes.normal), axes);
  expectSameCovariance(sampleCovariance(rate, p, axes, kTrials), rows * rows.transpose(), kTrials);
}

TEST(StretchWalk, StatesWhatAWalkOfThePositionDoesToTheGround) {
  Matrix6d rate = Matrix6d::Zero();
  rate.topLeftCorner<3, 3>() = testing_drift::walkRate().topLeftCorner<3, 3>();
  expectStated(rate, {3.2, 2.0, 0.0}, kGroundAxes);
  expectStated(rate, {0.8, -2.0, 0.0}, kGroundAxes);
}

TEST(StretchWalk, StatesWhatAWalkOfPositionAndTurnDoesToGroundAndWalls) {
  const Matrix6d rate = testing_drift::walkRate();
  expectStated(rate, {3.2, 6.0, 0.0}, kGroundAxes);
  expectStated(rate, {2.2, 5.0, 2.0}, kWallAxes);
  expectStated(rate, {1.0, 5.0, 4.0}, kWallAxes);
}

TEST(StretchWalk, TheSlopeOfAWalkOverLHasAVarianceOfOnePointTwoQTOverLSquared) {
  std::mt19937 random(5);
  Matrix6d rate = Matrix6d::Zero();
  const double q = rate(2, 2) = 25e-6;
  const DriftingPass pass(kWalkBegin, rate, random);
  const PlanePatch patch = pass.see({2.6, 2.0, 0.0}, Vector3d::UnitZ());
  const Eigen::MatrixXd rows = walkAlong(pass).rows(patch, kGroundAxes);
  const double seconds = std::sqrt(12.0) * patch.stamp_spread;  // and m: it drives at 1 m/s
  EXPECT_NEAR(rows.row(2).squaredNorm(), 1.2 * q / seconds, 0.1 * q);
  EXPECT_LT(rows.row(1).squaredNorm(), 1e-3 * q) << "across the direction of travel nothing is tilted";
}

TEST(StretchWalk, WithoutDriftThereIsNone) {
  std::mt19937 random(5);
  const DriftingPass pass(kWalkBegin, Matrix6d::Zero(), random);
  EXPECT_EQ(walkAlong(pass).size(), 0);
  EXPECT_EQ(StretchWalk(pass.mapped, kWalkBegin, kWalkBegin, kWalkBegin, nullptr).size(), 0);
}

}  // namespace
}  // namespace laser_mapper
