// SPDX-License-Identifier: BSD-3-Clause
#include "window/sensor_model.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/numeric_jacobian.hpp"
#include "urban_nav_core/testing/tracks.hpp"

namespace swf_vo {
namespace {

using Eigen::Vector3d;
using urban_nav_core::boxPlus;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

struct ModelScene {
  urban_nav_core::StereoCamera camera = urban_nav_core::testing::simulateTracks({1, 1}).camera;
  SensorModel model{camera};
  Anchor anchor;
  Pose T_odom_anchor{urban_nav_core::expSo3(Vector3d(0.4, -0.7, 0.2)), Vector3d(3.0, -1.0, 2.0)};

  ModelScene() {
    anchor.R_odom_anchor = T_odom_anchor.R();
    anchor.t_odom_anchor = T_odom_anchor.t();
  }
};

Vector6d poseTangent(double x, double y, double z, double a, double b, double c) {
  Vector6d d;
  d << x, y, z, a, b, c;
  return d;
}

// Also far from the anchor: half a metre and 40 deg.
const Vector6d kOffsets[] = {Vector6d::Zero(), poseTangent(0.02, -0.01, 0.03, 0.01, 0.02, -0.02),
                             poseTangent(0.3, -0.3, 0.25, 0.1, 0.6, -0.3)};
const Vector3d kThetas[] = {{0.1, -0.2, 0.3}, {-0.3, 0.1, 0.01}, {0.2, 0.2, 0.0}, {0.0, 0.1, -0.02}, {0.1, 0.0, 0.5}};

TEST(SensorModel, JacobiansAreThoseOfThePrediction) {
  const ModelScene scene;
  for (const Vector6d& offset : kOffsets)
    for (const Vector3d& theta : kThetas) {
      const Pose pose = boxPlus(scene.T_odom_anchor, offset);
      SensorModel::Linearised at;
      ASSERT_TRUE(scene.model.linearise(scene.anchor, theta, PoseMatrices(pose), at));
      const auto predict = [&](const Pose& T, const Vector3d& x) {
        Vector3d z;
        EXPECT_TRUE(scene.model.predict(scene.anchor, x, PoseMatrices(T), z));
        return z;
      };
      const auto by_pose =
          urban_nav_core::testing::numericJacobian<3, 6>([&](const Pose& T) { return predict(T, theta); }, pose);
      const auto by_theta =
          urban_nav_core::testing::numericJacobian<3, 3>([&](const Vector3d& x) { return predict(pose, x); }, theta);
      EXPECT_LT((at.pose() - by_pose).norm(), 1e-6 * (1.0 + by_pose.norm()))
          << offset.transpose() << " / " << theta.transpose();
      EXPECT_LT((at.landmark - by_theta).norm(), 1e-6 * (1.0 + by_theta.norm()))
          << offset.transpose() << " / " << theta.transpose();
    }
}

TEST(SensorModel, AgreesWithTheCameraAndWithItsOwnInverse) {
  const ModelScene scene;
  const Vector3d z(300.0, 120.0, 290.0);
  const Vector3d theta = scene.model.invert(z);
  Vector3d again;
  ASSERT_TRUE(scene.model.predict(scene.anchor, theta, PoseMatrices(scene.T_odom_anchor), again));
  EXPECT_LT((again - z).norm(), 1e-10);
  const Eigen::Vector4d point = scene.anchor.homogeneous(theta);
  const Pose elsewhere = boxPlus(scene.T_odom_anchor, kOffsets[1]);
  const auto expected = scene.camera.project(elsewhere.inverse() * Vector3d(point.head<3>() / point.w()));
  ASSERT_TRUE(expected && scene.model.predict(scene.anchor, theta, PoseMatrices(elsewhere), again));
  EXPECT_LT((again - *expected).norm(), 1e-10);
}

TEST(SensorModel, MovingEverythingTogetherChangesNothing) {
  const ModelScene scene;
  const Vector3d theta(0.1, -0.2, 0.3);
  const Pose pose = boxPlus(scene.T_odom_anchor, kOffsets[2]);
  SensorModel::Linearised at;
  ASSERT_TRUE(scene.model.linearise(scene.anchor, theta, PoseMatrices(pose), at));
  const Eigen::Vector4d h = scene.anchor.homogeneous(theta);
  const Vector3d p = h.head<3>() / h.w();
  // Derivative of theta by a point of odom; then that of pose and point by a shift and turn of odom.
  const auto by_point = urban_nav_core::testing::numericJacobian<3, 3>(
      [&](const Vector3d& x) -> Vector3d {
        const Vector3d q = scene.anchor.R_odom_anchor.transpose() * (x - scene.anchor.t_odom_anchor);
        return Vector3d(q.x() / q.z(), q.y() / q.z(), 1.0 / q.z());
      },
      p);
  Eigen::Matrix<double, 6, 6> pose_moves = Eigen::Matrix<double, 6, 6>::Identity();
  pose_moves.topRightCorner<3, 3>() = -urban_nav_core::skew(pose.t());
  Eigen::Matrix<double, 3, 6> point_moves;
  point_moves << Eigen::Matrix3d::Identity(), -urban_nav_core::skew(p);
  EXPECT_LT((at.pose() * pose_moves + at.landmark * by_point * point_moves).norm(), 1e-6 * at.pose().norm());
}

TEST(SensorModel, RejectsNegativeDepth) {
  const ModelScene scene;
  Vector3d z;
  SensorModel::Linearised at;
  const Pose ahead(scene.T_odom_anchor.q(), scene.T_odom_anchor * Vector3d(0.0, 0.0, 5.0));
  EXPECT_FALSE(scene.model.predict(scene.anchor, Vector3d(0.0, 0.0, 0.5), PoseMatrices(ahead), z));
  EXPECT_FALSE(scene.model.linearise(scene.anchor, Vector3d(0.0, 0.0, 0.5), PoseMatrices(ahead), at));
  EXPECT_FALSE(scene.model.predict(scene.anchor, Vector3d(0.0, 0.0, std::nan("")), PoseMatrices(ahead), z));
}

}  // namespace
}  // namespace swf_vo
