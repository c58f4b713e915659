// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/compose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "urban_nav_core/testing/numeric_jacobian.hpp"

namespace urban_nav_core {
namespace {

using testing::numericJacobian;

class ComposeAt : public ::testing::TestWithParam<double> {
 protected:
  // Two poses 0.5 m off with rotations of the parameter's size: Jacobians that drop a term which vanishes at zero fail
  // here.
  ComposeAt() : random_(11) {}
  Pose pose(double length) {
    std::normal_distribution<double> n;
    const Vector3d axis(n(random_), n(random_), n(random_)), way(n(random_), n(random_), n(random_));
    return Pose(expSo3(GetParam() * axis.normalized()), length * way.normalized());
  }
  std::mt19937 random_;
};

TEST_P(ComposeAt, JacobiansOfTheCompositionAreNumericDerivatives) {
  const Pose A = pose(0.5), B = pose(7.0);
  const Composition c = compose(A, B);
  EXPECT_TRUE(isApprox(c.T_a_c, A * B, 0.0));
  EXPECT_LE((numericJacobian<6, 6>([&B](const Pose& X) { return X * B; }, A) - c.J1).norm(), 1e-9);
  EXPECT_LE((numericJacobian<6, 6>([&A](const Pose& X) { return A * X; }, B) - c.J2).norm(), 1e-9);
}

TEST_P(ComposeAt, JacobianOfTheInverseIsTheNumericDerivative) {
  const Pose A = pose(0.5);
  EXPECT_LE((numericJacobian<6, 6>([](const Pose& X) { return X.inverse(); }, A) - invert(A).J).norm(), 1e-9);
  EXPECT_TRUE(isApprox(invert(A).T_b_a, A.inverse(), 0.0));
}

TEST_P(ComposeAt, JacobiansOfTheDifferenceAreNumericDerivatives) {
  const Pose A = pose(0.5), C = pose(3.0);
  const Between b = between(A, C);
  EXPECT_TRUE(isApprox(A * b.T_b_c, C, 1e-14));
  EXPECT_LE((numericJacobian<6, 6>([&C](const Pose& X) { return X.inverse() * C; }, A) - b.J1).norm(), 1e-9);
  EXPECT_LE((numericJacobian<6, 6>([&A](const Pose& X) { return A.inverse() * X; }, C) - b.J2).norm(), 1e-9);
}

TEST_P(ComposeAt, InvertingTwiceIsNothing) {
  const PoseWithCovariance A{pose(0.5), Matrix6d::Identity() + Matrix6d::Constant(0.3)};
  EXPECT_TRUE(isApprox(invert(invert(A)), A, 1e-13));
}

TEST_P(ComposeAt, CovarianceOfAChainDoesNotDependOnTheBrackets) {
  const PoseWithCovariance A{pose(0.5), Matrix6d::Identity() * 0.1}, B{pose(1.0), Matrix6d::Identity() * 0.2},
      C{pose(2.0), Matrix6d::Identity() * 0.3 + Matrix6d::Constant(0.05)};
  EXPECT_TRUE(isApprox(compose(compose(A, B), C), compose(A, compose(B, C)), 1e-12));
}

INSTANTIATE_TEST_SUITE_P(Angles, ComposeAt,
                         ::testing::Values(0.0, 1e-7, 0.1, 40.0 * M_PI / 180.0, 2.0, M_PI - 1e-3, M_PI));

TEST(Compose, CovarianceAgreesWithSamples) {
  const PoseWithCovariance A{Pose(expSo3({0.1, 0.7, -0.3}), {1.0, 2.0, 0.5}),
                             Vector6d(Vector6d::Constant(1e-6)).asDiagonal()};
  const PoseWithCovariance B{Pose(expSo3({-0.4, 0.2, 0.6}), {3.0, -1.0, 2.0}),
                             Vector6d(Vector6d::Constant(4e-6)).asDiagonal()};
  const PoseWithCovariance C = compose(A, B);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto draw = [&](double sigma) {
    Vector6d d;
    for (int i = 0; i < 6; ++i) d[i] = sigma * normal(random);
    return d;
  };
  constexpr int kDraws = 20000;
  Matrix6d sum = Matrix6d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Vector6d d = boxMinus(boxPlus(A.pose, draw(1e-3)) * boxPlus(B.pose, draw(2e-3)), C.pose);
    sum += d * d.transpose() / kDraws;
  }
  EXPECT_LE((sum - C.covariance).norm(), 0.04 * C.covariance.norm());
}

}  // namespace
}  // namespace urban_nav_core
