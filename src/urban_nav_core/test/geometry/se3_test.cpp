// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/se3.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

namespace urban_nav_core {
namespace {

constexpr double kDegree = M_PI / 180.0;

Vector6d randomTangent(std::mt19937& random, double length, double angle) {
  std::normal_distribution<double> normal;
  const Vector3d rho(normal(random), normal(random), normal(random)),
      phi(normal(random), normal(random), normal(random));
  Vector6d x;
  x << length * rho.normalized(), angle * phi.normalized();
  return x;
}

Pose randomPose(std::mt19937& random) { return expSe3(randomTangent(random, 5.0, 2.0)); }

TEST(Pose, ActsAsItsMatrix) {
  std::mt19937 random(1);
  const Pose A = randomPose(random), B = randomPose(random);
  const Vector3d p(0.3, -4.0, 1.0);
  EXPECT_LE((((A * B).matrix() - A.matrix() * B.matrix())).norm(), 1e-14);
  EXPECT_LE((A.matrix() * p.homogeneous() - (A * p).homogeneous()).norm(), 1e-14);
  EXPECT_TRUE(isApprox(A * A.inverse(), Pose(), 1e-14));
  EXPECT_TRUE(isApprox(A.inverse() * A, Pose(), 1e-14));
}

TEST(Pose, AMillionProductsStayARotation) {
  const Pose step(expSo3({0.01, -0.02, 0.03}), {0.001, 0.0, 0.0});
  Pose T;
  for (int i = 0; i < 1000000; ++i) T = T * step;
  EXPECT_NEAR(T.q().norm(), 1.0, 1e-15);
}

TEST(Pose, TakesTheNearestRotation) {
  std::mt19937 random(2);
  const Matrix3d R = randomPose(random).R();
  Matrix3d noise;
  noise << 1, -2, 3, 2, 1, -1, 0, 2, -3;
  EXPECT_LE((Pose(R, Vector3d::Zero()).R() - R).norm(), 1e-15);
  const Matrix3d stretched =
      R * (Matrix3d::Identity() + 1e-3 * (noise + noise.transpose()));  // a symmetric factor turns nothing
  EXPECT_LE((Pose(stretched, Vector3d::Zero()).R() - R).norm(), 1e-14);
  EXPECT_LE((Pose(R + 1e-3 * noise, Vector3d::Zero()).R() - R).norm(), 1e-2);
}

TEST(Pose, NormalisesItsQuaternion) {
  const Pose T(Quaterniond(2.0, 0.0, 0.0, 0.0), Vector3d::Zero());
  EXPECT_EQ(T.q().w(), 1.0);
}

TEST(Pose, ReportsWhetherItIsFinite) {
  EXPECT_TRUE(Pose().isFinite());
  EXPECT_FALSE(Pose(Quaterniond::Identity(), Vector3d(0.0, NAN, 0.0)).isFinite());
}

TEST(Pose, PrintsItself) {
  std::ostringstream out;
  out << Pose(expSo3({0.0, 0.0, 0.5}), {1.0, -2.0, 0.25});
  EXPECT_EQ(out.str(), "t = (1, -2, 0.25) m, rotation vector = (0, 0, 0.5) rad");
}

TEST(Pose, ComparesToATolerance) {
  const Pose A(expSo3({0.0, 0.0, 0.5}), {1.0, 2.0, 3.0});
  Vector6d d = Vector6d::Zero();
  d[1] = 1e-3;
  EXPECT_TRUE(isApprox(A, boxPlus(A, d), 1.1e-3));
  EXPECT_FALSE(isApprox(A, boxPlus(A, d), 0.9e-3));
  d = Vector6d::Unit(5) * 1e-3;
  EXPECT_TRUE(isApprox(A, boxPlus(A, d), 1.1e-3));
  EXPECT_FALSE(isApprox(A, boxPlus(A, d), 0.9e-3));
  EXPECT_NEAR(angleBetween(A, boxPlus(A, d)), 1e-3, 1e-15);
  EXPECT_FALSE(isApprox(A, Pose(A.q(), Vector3d(NAN, 0, 0)), 1e9));
}

TEST(Se3, LogUndoesExp) {
  std::mt19937 random(3);
  for (const double angle : {0.0, 1e-12, 1e-6, 0.3, 1.0, 3.0, M_PI - 1e-6}) {
    const Vector6d x = randomTangent(random, 0.5, angle);
    EXPECT_LE((logSe3(expSe3(x)) - x).norm(), 1e-14) << angle;
  }
}

TEST(Se3, ExpSolvesItsDifferentialEquation) {
  std::mt19937 random(4);
  const Vector6d x = randomTangent(random, 0.5, 40.0 * kDegree);
  Pose T;  // many small steps with the same twist
  const Pose step(expSo3(x.tail<3>() / 1048576.0), x.head<3>() / 1048576.0);
  Pose doubled = step;
  for (int i = 0; i < 20; ++i) doubled = doubled * doubled;
  T = doubled;
  EXPECT_TRUE(isApprox(T, expSe3(x), 1e-6));
}

TEST(Se3, AdjointMovesATangentAcross) {
  std::mt19937 random(5);
  const Pose T = randomPose(random);
  const Vector6d x = randomTangent(random, 0.5, 40.0 * kDegree);
  EXPECT_TRUE(isApprox(T * expSe3(x) * T.inverse(), expSe3(adjoint(T) * x), 1e-13));
}

TEST(Se3, BoxMinusUndoesBoxPlus) {
  std::mt19937 random(7);
  const Pose T = randomPose(random);
  for (const double angle : {0.0, 1e-9, 40.0 * kDegree, 3.1}) {
    const Vector6d d = randomTangent(random, 0.5, angle);
    EXPECT_LE((boxMinus(boxPlus(T, d), T) - d).norm(), 1e-14) << angle;
  }
}

TEST(Se3, BoxPlusIsInTheParentFrame) {
  const Pose T(expSo3({0.0, 0.0, M_PI / 2}), {1.0, 0.0, 0.0});
  Vector6d d;
  d << 0.1, 0.2, 0.3, 0.0, 0.0, M_PI / 2;
  const Pose moved = boxPlus(T, d);
  EXPECT_TRUE(moved.t().isApprox(Vector3d(1.1, 0.2, 0.3), 1e-15));
  EXPECT_TRUE((moved.R() * Vector3d::UnitX()).isApprox(-Vector3d::UnitX(), 1e-15));
}

}  // namespace
}  // namespace urban_nav_core
