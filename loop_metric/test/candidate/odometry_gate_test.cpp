// SPDX-License-Identifier: BSD-3-Clause
#include "candidate/odometry_gate.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::Constraint;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

PlaceData::OdometryPath makePath(double sigma_m, double sigma_rad, double length) {
  PlaceData::OdometryPath path;
  path.T_a_b.pose = Pose(urban_nav_core::expSo3({0.0, 0.0, 0.3}), {3.0, 1.0, 0.0});
  path.T_a_b.covariance.setZero();
  path.T_a_b.covariance.diagonal() << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  path.length = length;
  return path;
}

TEST(OdometryGate, CountsStandardDeviationsOverBothErrors) {
  const OdometryGate gate(makePath(0.3, 0.01, 0.0), 0.0);
  Constraint measured;
  measured.T_a_b = boxPlus(gate.T_a_b().pose, (Vector6d() << 1.0, 0, 0, 0, 0, 0).finished());
  measured.information.diagonal() << Eigen::Vector3d::Constant(1.0 / 0.16), Eigen::Vector3d::Constant(1e6);
  EXPECT_NEAR(gate.deviations(measured), std::sqrt(1.0 / (0.09 + 0.16) / 6.0), 1e-3);
}

TEST(OdometryGate, AgreesWithTheInverseOfTheSumOfCovariancesWhereItExists) {
  urban_nav_core::testing::Dice dice(3);
  for (int trial = 0; trial < 20; ++trial) {
    Matrix6d A, B;
    for (int i = 0; i < 36; ++i) {
      A.data()[i] = dice.normal();
      B.data()[i] = dice.normal();
    }
    const Matrix6d covariance = A * A.transpose() + 0.1 * Matrix6d::Identity(),
                   information = B * B.transpose() + 0.1 * Matrix6d::Identity();
    const Vector6d d = dice.normals<6>();
    const Matrix6d sum = covariance + Matrix6d(*urban_nav_core::invertPositiveDefinite(information));
    const double expected = std::sqrt(d.dot(Matrix6d(*urban_nav_core::invertPositiveDefinite(sum)) * d) / 6.0);
    EXPECT_NEAR(rootMeanDeviation(d, covariance, information), expected, 1e-9 * (1.0 + expected));
  }
}

TEST(OdometryGate, AFreeDirectionCountsForNothing) {
  const OdometryGate gate(makePath(0.1, 0.01, 0.0), 0.0);
  Constraint measured;
  measured.T_a_b = boxPlus(gate.T_a_b().pose, (Vector6d() << 5.0, 0.1, 0, 0, 0, 0).finished());
  measured.information.diagonal() << 0.0, Eigen::Vector2d::Constant(1e4), Eigen::Vector3d::Constant(1e6);
  EXPECT_NEAR(gate.deviations(measured), std::sqrt(0.01 / (0.01 + 1e-4) / 5.0), 1e-2);
  measured.information.setZero();
  EXPECT_EQ(gate.deviations(measured), 0.0);
}

TEST(OdometryGate, AScaleErrorGrowsWithTheDistance) {
  const OdometryGate near(makePath(0.1, 0.01, 10.0), 0.01), far(makePath(0.1, 0.01, 1000.0), 0.01);
  Constraint other;
  other.T_a_b = boxPlus(near.T_a_b().pose, (Vector6d() << 0, 5.0, 0, 0, 0, 0).finished());
  other.information.diagonal() << Eigen::Vector3d::Constant(100.0), Eigen::Vector3d::Constant(1e4);
  EXPECT_GT(near.deviations(other), 10.0);
  EXPECT_LT(far.deviations(other), 1.0);
}

TEST(OdometryGate, BoundsTheDistanceOfTheMoments) {
  PlaceData::OdometryPath path = makePath(1.0, 0.01, 0.0);
  path.T_a_b.pose = Pose(urban_nav_core::Quaterniond::Identity(), {30.0, 0.0, 0.0});
  const OdometryGate gate(path, 0.0);
  EXPECT_NEAR(gate.leastDistance(5.0), 30.0 - 5.0 * std::sqrt(3.0), 1e-3);
  EXPECT_EQ(gate.leastDistance(50.0), 0.0);
}

}  // namespace
}  // namespace loop_metric
