// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/so3.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "urban_nav_core/testing/numeric_jacobian.hpp"

namespace urban_nav_core {
namespace {

using testing::numericJacobian;

Vector3d randomAxis(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

// From the transition between series and quotients to just below half a turn.
const double kAngles[] = {0.0,  1e-300, 1e-12, 1e-8, 1e-5, 1e-4, 1.1e-4, 0.01, 0.29, 0.31,
                          0.69, 0.71,   0.79,  0.81, 1.19, 1.21, 2.0,    3.0,  3.14, M_PI - 1e-7};

TEST(So3, SkewIsTheCrossProduct) {
  const Vector3d a(1.0, -2.0, 3.0), b(0.5, 4.0, -1.0);
  EXPECT_EQ((skew(a) * b - a.cross(b)).norm(), 0.0);
  EXPECT_EQ((skew(a) + skew(a).transpose()).norm(), 0.0);
}

TEST(So3, ExpIsTheRotationAboutTheAxis) {
  const Matrix3d R = expSo3({0.0, 0.0, M_PI / 2}).toRotationMatrix();
  EXPECT_TRUE((R * Vector3d::UnitX()).isApprox(Vector3d::UnitY(), 1e-15));
  EXPECT_EQ(expSo3(Vector3d::Zero()).coeffs(), Quaterniond::Identity().coeffs());
}

TEST(So3, LogUndoesExpAtEveryAngle) {
  std::mt19937 random(1);
  for (const double angle : kAngles) {
    const Vector3d phi = angle * randomAxis(random);
    const Vector3d back = logSo3(expSo3(phi));
    EXPECT_LE((back - phi).norm(), 4e-16 * (1.0 + angle)) << angle;
    if (angle > 0.0 && angle < 1e-3) {
      EXPECT_LE((back - phi).norm(), 1e-15 * angle) << "small angles retain their precision: " << angle;
    }
  }
}

TEST(So3, LogOfBothSignsIsOneRotation) {
  std::mt19937 random(2);
  for (const double angle : {0.0, 0.1, 1.0, 3.0, M_PI}) {
    const Quaterniond q = expSo3(angle * randomAxis(random));
    const Quaterniond minus(-q.w(), -q.x(), -q.y(), -q.z());
    EXPECT_LE((logSo3(q) - logSo3(minus)).norm(), 1e-15) << angle;
  }
  EXPECT_EQ(logSo3(Quaterniond(0, 0, -1, 0)), logSo3(Quaterniond(0, 0, 1, 0)));
}

TEST(So3, LogStaysWithinHalfATurn) {
  EXPECT_NEAR(logSo3(expSo3({0.0, 0.0, M_PI + 0.1})).z(), -M_PI + 0.1, 1e-15);
  EXPECT_NEAR(logSo3(Quaterniond(0.0, 1.0, 0.0, 0.0)).norm(), M_PI, 1e-15);
}

TEST(So3, LogTakesAQuaternionOfAnotherLength) {
  const Vector3d phi(0.3, -0.2, 0.9);
  Quaterniond q = expSo3(phi);
  q.coeffs() *= 1.0 + 1e-6;
  EXPECT_LE((logSo3(q) - phi).norm(), 1e-15);
}

TEST(So3, LeftJacobianIsTheNumericDerivative) {
  std::mt19937 random(3);
  for (const double angle : {0.0, 1e-6, 0.1, 0.69, 0.71, 1.0, 2.5, 3.1}) {
    const Vector3d phi = angle * randomAxis(random);
    const Matrix3d J = numericJacobian<3, 3>([](const Vector3d& x) { return expSo3(x); }, phi);
    EXPECT_LE((J - leftJacobianSo3(phi)).norm(), 1e-10) << angle;
  }
}

TEST(So3, InverseOfTheLeftJacobian) {
  std::mt19937 random(4);
  for (const double angle : kAngles) {
    const Vector3d phi = angle * randomAxis(random);
    EXPECT_LE((leftJacobianSo3(phi) * leftJacobianInverseSo3(phi) - Matrix3d::Identity()).norm(), 1e-13) << angle;
  }
  const Vector3d beyond(0.0, 0.0, 5.0);
  EXPECT_LE((leftJacobianSo3(beyond) * leftJacobianInverseSo3(beyond) - Matrix3d::Identity()).norm(), 1e-13);
}

TEST(So3, LeftJacobianTurnsLikeItsRotation) {
  const Vector3d phi(0.4, -1.2, 0.3);  // R J(-phi) = J(phi)
  EXPECT_LE((expSo3(phi).toRotationMatrix() * leftJacobianSo3(-phi) - leftJacobianSo3(phi)).norm(), 1e-15);
}

}  // namespace
}  // namespace urban_nav_core
