// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/covariance_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_core/testing/numeric_jacobian.hpp"

namespace urban_nav_core {
namespace {

using testing::numericJacobian;

const Pose kT(expSo3({0.3, -0.8, 1.1}), {4.0, -2.0, 0.7});
const Pose kT_base_camera(expSo3({-1.2, 1.2, -1.1}), {0.1, 0.05, 1.1});

Matrix6d wavyCovariance() {
  Matrix6d A = Matrix6d::Identity();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) A(i, j) += 0.1 * std::sin(1.0 + 3.0 * i + 7.0 * j);
  }
  return 0.01 * A * A.transpose();
}

TEST(CovarianceFrames, BoxFromLeftIsTheNumericDerivative) {
  const auto f = [](const Vector6d& d) { return Pose(expSe3(d) * kT); };
  EXPECT_LE((numericJacobian<6, 6>(f, Vector6d(Vector6d::Zero())) - boxFromLeft(kT)).norm(), 1e-9);
  EXPECT_LE((boxFromLeft(kT) * leftFromBox(kT) - Matrix6d::Identity()).norm(), 1e-14);
}

TEST(CovarianceFrames, BoxFromRightIsTheNumericDerivative) {
  const auto f = [](const Vector6d& d) { return Pose(kT * expSe3(d)); };
  EXPECT_LE((numericJacobian<6, 6>(f, Vector6d(Vector6d::Zero())) - boxFromRight(kT)).norm(), 1e-9);
  EXPECT_LE((boxFromRight(kT) * rightFromBox(kT) - Matrix6d::Identity()).norm(), 1e-14);
}

TEST(CovarianceFrames, LeftAndRightDifferByTheAdjoint) {
  EXPECT_LE((leftFromBox(kT) * boxFromRight(kT) - adjoint(kT)).norm(), 1e-13);
}

TEST(CovarianceFrames, PoseOfTheCameraMovesToTheBase) {
  const PoseWithCovariance camera{kT, wavyCovariance()};
  const PoseWithCovariance base = baseFromCamera(camera, kT_base_camera);
  EXPECT_TRUE(isApprox(base.pose * kT_base_camera, kT, 1e-14));
  const auto f = [](const Pose& X) { return X * kT_base_camera.inverse(); };
  const Matrix6d J = numericJacobian<6, 6>(f, kT);
  EXPECT_LE((J * camera.covariance * J.transpose() - base.covariance).norm(), 1e-10);
  EXPECT_TRUE(isApprox(baseFromCamera(base, kT_base_camera.inverse()), camera, 1e-13));
}

TEST(CovarianceFrames, MotionOfTheCameraMovesToTheBase) {
  const PoseWithCovariance motion{Pose(expSo3({0.0, 0.6, 0.1}), {0.2, 0.0, 0.9}), wavyCovariance()};
  const PoseWithCovariance base = baseMotionFromCameraMotion(motion, kT_base_camera);
  const auto f = [](const Pose& X) { return kT_base_camera * X * kT_base_camera.inverse(); };
  EXPECT_TRUE(isApprox(base.pose, f(motion.pose), 1e-14));
  const Matrix6d J = numericJacobian<6, 6>(f, motion.pose);
  EXPECT_LE((J * motion.covariance * J.transpose() - base.covariance).norm(), 1e-10);
}

TEST(CovarianceFrames, MotionsOfTheBaseMultiplyUpLikeThoseOfTheCamera) {
  const PoseWithCovariance step{Pose(expSo3({0.0, 0.2, 0.0}), {0.0, 0.0, 1.0}), wavyCovariance()};
  const PoseWithCovariance by_camera = baseMotionFromCameraMotion(compose(step, step), kT_base_camera);
  const PoseWithCovariance base_step = baseMotionFromCameraMotion(step, kT_base_camera);
  EXPECT_TRUE(isApprox(by_camera, compose(base_step, base_step), 1e-12));
}

TEST(CovarianceFrames, RelativeToTheFirstTurnsTheAxes) {
  const PoseWithCovariance base{kT, wavyCovariance()};
  const PoseWithCovariance relative = relativeToFirst(base, kT_base_camera);
  EXPECT_TRUE(isApprox(kT_base_camera * relative.pose, kT, 1e-14));
  const auto f = [](const Pose& X) { return kT_base_camera.inverse() * X; };
  const Matrix6d J = numericJacobian<6, 6>(f, kT);
  EXPECT_LE((J * base.covariance * J.transpose() - relative.covariance).norm(), 1e-10);
}

TEST(CovarianceFrames, InformationOfMovedTangentIsTheInverseOfItsCovariance) {
  const Matrix6d J = boxFromLeft(kT), covariance = wavyCovariance();
  const Matrix6d information = transformInformation(leftFromBox(kT), covariance.inverse());
  EXPECT_LE((information * transformCovariance(J, covariance) - Matrix6d::Identity()).norm(), 1e-9);
}

TEST(CovarianceFrames, HalvesChangePlaces) {
  Matrix6d M = Matrix6d::Zero();
  M(0, 1) = 1.0;
  M(4, 2) = 2.0;
  const Matrix6d S = swapHalves(M);
  EXPECT_EQ(S(3, 4), 1.0);
  EXPECT_EQ(S(1, 5), 2.0);
  EXPECT_EQ(swapHalves(S), M);
}

TEST(CovarianceFrames, DisplayShowsFreeDirectionsAsVeryLong) {
  Vector6d information = Vector6d::Constant(100.0);
  information[1] = 0.0;
  information[5] = 0.0;
  const Matrix6d covariance = covarianceForDisplay(information.asDiagonal(), 10.0);
  EXPECT_NEAR(covariance(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 1e6, 1e-3);
  EXPECT_NEAR(covariance(4, 4), 0.01, 1e-12);
  EXPECT_NEAR(covariance(5, 5), 10.0, 1e-9);
  const Matrix6d nothing = covarianceForDisplay(Matrix6d::Zero(), 10.0);
  EXPECT_NEAR(nothing(2, 2), 1e6, 1e-3);
  EXPECT_NEAR(nothing(3, 3), 10.0, 1e-9);
}

TEST(CovarianceFrames, DisplayOfFullInformationIsItsInverse) {
  const Matrix6d covariance = wavyCovariance();
  EXPECT_LE((covarianceForDisplay(covariance.inverse(), 3.0) - covariance).norm(), 1e-12);
}

}  // namespace
}  // namespace urban_nav_core
