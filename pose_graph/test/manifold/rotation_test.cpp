// SPDX-License-Identifier: BSD-3-Clause
#include "manifold/rotation.hpp"

#include <limits>

#include "support/drawn.hpp"

namespace pose_graph::test {
namespace {

template <int D>
void expectExpAndLog() {
  Dice dice(1);
  for (int run = 0; run < 100; ++run) {
    RotationVector<D> phi;
    for (int i = 0; i < kRotationSize<D>; ++i) phi[i] = dice.normal();
    phi *= 3.14 * dice.uniform() / phi.norm();
    const Rotation<D> R = expRotation(phi);
    EXPECT_LT((R * R.transpose() - Rotation<D>::Identity()).norm(), 1e-14);
    EXPECT_LT((logRotation(R) - phi).norm(), 1e-12);
  }
}
TEST(Rotation, LogUndoesExp) {
  expectExpAndLog<2>();
  expectExpAndLog<3>();
}

TEST(Rotation, TurnedIsTheDerivativeOfATurn) {
  Dice dice(2);
  const Eigen::Vector2d v = dice.normals<2>();
  const double h = 1e-6;
  EXPECT_LT(
      ((expRotation(RotationVector<2>(h)) * v - expRotation(RotationVector<2>(-h)) * v) / (2 * h) - turned(v)).norm(),
      1e-9);
  const Eigen::Vector3d w = dice.normals<3>(), d = dice.normals<3>();
  const Eigen::Vector3d ahead = expRotation(Eigen::Vector3d(h * d)) * w,
                        before = expRotation(Eigen::Vector3d(-h * d)) * w;
  EXPECT_LT(((ahead - before) / (2 * h) - turned(w) * d).norm(), 1e-9);
}

/// No randomly drawn rotation is nearer.
template <int D>
void expectNearest() {
  Dice dice(3);
  for (int run = 0; run < 30; ++run) {
    Eigen::Matrix<double, D, D> M;
    for (int i = 0; i < D * D; ++i) M(i) = dice.normal();
    if (run % 5 == 0) M.col(0) = 2.0 * M.col(D - 1);  // singular
    const Rotation<D> R = nearestRotation(M);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
    EXPECT_LT((R * R.transpose() - Rotation<D>::Identity()).norm(), 1e-12);
    for (int other = 0; other < 50; ++other) {
      const Rotation<D> turn = drawRigid<D>(dice, 0.0, other % 2 == 0 ? 0.01 : 2.0).R;
      EXPECT_GE((turn * R - M).norm(), (R - M).norm() - 1e-9);
    }
  }
}
TEST(Rotation, NearestIsNearest) {
  expectNearest<2>();
  expectNearest<3>();
}

TEST(Rotation, NearestOfNothingIsARotation) {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {0.0, infinity, nan, 1e200}) {
    const Rotation<2> plane = nearestRotation(Eigen::Matrix2d(Eigen::Matrix2d::Constant(value)));
    const Rotation<3> space = nearestRotation(Eigen::Matrix3d(Eigen::Matrix3d::Constant(value)));
    EXPECT_NEAR(plane.determinant(), 1.0, 1e-12) << value;
    EXPECT_NEAR(space.determinant(), 1.0, 1e-12) << value;
  }
}

TEST(Rotation, MovedTurnsAndShiftsInTheParentFrame) {
  Dice dice(4);
  const Rigid<3> T = drawRigid<3>(dice, 2.0, 1.0);
  const Tangent<3> d = drawTangent<3>(dice, 1.0, 0.5);
  const Rigid<3> made = moved(T, d);
  const urban_nav_core::Pose expected = urban_nav_core::boxPlus(toPose(T), d);
  EXPECT_LT((made.R - expected.R()).norm() + (made.t - expected.t()).norm(), 1e-12);
}

}  // namespace
}  // namespace pose_graph::test
