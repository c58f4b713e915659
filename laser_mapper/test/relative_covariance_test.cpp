// SPDX-License-Identifier: BSD-3-Clause
#include "relative_covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "urban_nav_core/geometry/so3.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;

constexpr int kChainPoses = 161;

/// Three sides of a square of 20 m, with poses 0.375 m apart.
Trajectory threeSides() {
  Trajectory made;
  for (int i = 0; i < kChainPoses; ++i) {
    const double s = 0.375 * i;
    Vector3d p(s, 0.0, 0.0);
    if (s > 20.0) p = {20.0, s - 20.0, 0.0};
    if (s > 40.0) p = {60.0 - s, 20.0, 0.0};
    made.append(50'000'000LL * (i + 1), Pose(Eigen::Quaterniond::Identity(), p));
  }
  return made;
}

/// Returns the error of a pose (rho, phi) caused by the error of an earlier one.
Vector6d carriedError(const Vector6d& error, const Vector3d& lever) {
  Vector6d carried = error;
  carried.head<3>() += error.tail<3>().cross(lever);
  return carried;
}

/// Errors of the poses of one chain of independent steps.
std::vector<Vector6d> drawnErrors(const Trajectory& trajectory, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<Vector6d> errors(trajectory.size(), Vector6d::Zero());
  for (std::size_t i = 1; i < errors.size(); ++i) {
    errors[i] = carriedError(errors[i - 1], trajectory[i].pose.t() - trajectory[i - 1].pose.t());
    for (int k = 0; k < 6; ++k) errors[i](k) += (k < 3 ? 2e-3 : 3e-4) * normal(random);
  }
  return errors;
}

/// Subtracts the best motion of the whole map from errors, for points 8 m to all sides of the poses.
void alignErrors(const Trajectory& trajectory, std::vector<Vector6d>& errors) {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  const double reach = 8.0;
  for (std::size_t i = 0; i < errors.size(); ++i)
    for (int side = 0; side < 6; ++side) {
      const Vector3d lever = (side % 2 == 0 ? reach : -reach) * Vector3d::Unit(side / 2);
      Eigen::Matrix<double, 3, 6> jacobian;
      jacobian << Eigen::Matrix3d::Identity(), -urban_nav_core::skew(trajectory[i].pose.t() + lever);
      information += jacobian.transpose() * jacobian;
      gradient += jacobian.transpose() * carriedError(errors[i], lever).head<3>();
    }
  const Vector6d motion = information.ldlt().solve(gradient);
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] -= carriedError(motion, trajectory[i].pose.t());
}

TEST(RelativeCovariances, AreThoseOfAlignedChains) {
  const Trajectory trajectory = threeSides();
  const int chains = 3000;
  std::mt19937 random(1);
  std::vector<Matrix6d> from_first(trajectory.size(), Matrix6d::Zero()), aligned(trajectory.size(), Matrix6d::Zero());
  for (int chain = 0; chain < chains; ++chain) {
    std::vector<Vector6d> errors = drawnErrors(trajectory, random);
    for (std::size_t i = 0; i < errors.size(); ++i) from_first[i] += errors[i] * errors[i].transpose() / chains;
    alignErrors(trajectory, errors);
    for (std::size_t i = 0; i < errors.size(); ++i) aligned[i] += errors[i] * errors[i].transpose() / chains;
  }
  const RelativeCovariances made(trajectory, from_first);
  for (const std::size_t pose : {0U, 40U, 80U, 120U, 160U})
    for (int k = 0; k < 6; ++k) {
      const double ratio = std::sqrt(made.at(pose)(k, k) / aligned[pose](k, k));
      EXPECT_NEAR(ratio, 1.0, 0.15) << "pose " << pose << ", coordinate " << k;
    }
}

TEST(RelativeCovariances, AnErrorOfAllPosesIsNone) {
  const Trajectory trajectory = threeSides();
  std::vector<Matrix6d> common;
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal() << 1e-2, 2e-2, 3e-2, 0.0, 0.0, 0.0;
  for (std::size_t i = 0; i < trajectory.size(); ++i) common.push_back(covariance);
  const RelativeCovariances made(trajectory, common);
  for (std::size_t pose = 0; pose < trajectory.size(); pose += 20) EXPECT_LT(made.at(pose).norm(), 1e-10);
}

TEST(RelativeCovariances, ArePositiveWhereClosuresMadeTheLastPosesCertain) {
  const Trajectory trajectory = threeSides();
  std::vector<Matrix6d> bridge;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const double s = static_cast<double>(i) / (kChainPoses - 1);
    bridge.push_back(Matrix6d::Identity() * 1e-3 * s * (1.0 - s));
  }
  const RelativeCovariances made(trajectory, bridge);
  for (const Matrix6d& covariance : made.values())
    EXPECT_GT(covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12);
  EXPECT_LT(made.at(80).trace(), 1e-2);
}

TEST(RelativeCovariances, AnEmptyTrajectoryIsExact) {
  EXPECT_EQ(RelativeCovariances(Trajectory(), {}).at(5), Matrix6d(Matrix6d::Zero()));
}

}  // namespace
}  // namespace laser_mapper
