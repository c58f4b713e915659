// SPDX-License-Identifier: BSD-3-Clause
#include "window/gauge.hpp"

#include <gtest/gtest.h>

#include "window/process_model.hpp"
#include "window/track_runner.hpp"

namespace swf_vo {
namespace {

using Eigen::Vector3d;
using urban_nav_core::expSo3;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

const Vector3d kOrigin(1.0, -2.0, 0.5);
const Pose kT_odom_camera(expSo3(Vector3d(0.3, -0.8, 0.2)), Vector3d(2.0, 0.4, -1.0));

// The world shifted and rotated about `kOrigin`.
Pose movement(const Vector6d& x) {
  const Eigen::Quaterniond turn = expSo3(x.tail<3>());
  return Pose(turn, kOrigin + x.head<3>() - turn * kOrigin);
}

Anchor someAnchor() { return {expSo3(Vector3d(-0.2, 0.5, 0.1)).toRotationMatrix(), Vector3d(0.7, -0.1, 0.9)}; }

// Inverse-depth coordinates of a point of `odom`, with its homogeneous scale.
Vector3d computeTheta(const Anchor& anchor, const Eigen::Vector4d& point) {
  const Vector3d p = anchor.R_odom_anchor.transpose() * (point.head<3>() - point.w() * anchor.t_odom_anchor);
  return Vector3d(p.x() / p.z(), p.y() / p.z(), point.w() / p.z());
}

TEST(Gauge, MovesAPoseAsTheWorldMoves) {
  const Matrix6d G = gauge::ofPose(kT_odom_camera, kOrigin);
  constexpr double kH = 1e-6;
  for (int c = 0; c < 6; ++c) {
    const Vector6d x = kH * Vector6d::Unit(c);
    const Vector6d d =
        urban_nav_core::boxMinus(movement(x) * kT_odom_camera, movement(-x) * kT_odom_camera) / (2.0 * kH);
    EXPECT_LT((G.col(c) - d).norm(), 1e-8) << c;
  }
}

TEST(Gauge, MovesALandmarkAsTheWorldMoves) {
  const Anchor anchor = someAnchor();
  constexpr double kH = 1e-6;
  for (const double rho : {0.3, 1e-3, 0.0, -0.01}) {
    const Vector3d theta(0.2, -0.3, rho);
    const auto G = gauge::ofLandmark(anchor, theta, kOrigin);
    const Eigen::Vector4d point = anchor.homogeneous(theta);
    const auto moved = [&](const Vector6d& x) {
      Eigen::Vector4d q = point;
      q.head<3>() = movement(x).q() * point.head<3>() + point.w() * movement(x).t();
      return computeTheta(anchor, q);
    };
    for (int c = 0; c < 6; ++c) {
      const Vector6d x = kH * Vector6d::Unit(c);
      EXPECT_LT((G.col(c) - (moved(x) - moved(-x)) / (2.0 * kH)).norm(), 1e-8) << rho << ", " << c;
    }
  }
}

TEST(Gauge, HasNoInformationFromAnyTerm) {
  const Anchor anchor = someAnchor();
  const Vector3d theta(0.2, -0.3, 0.15);
  const SensorModel sensor(urban_nav_core::testing::simulateTracks({}).camera);
  SensorModel::Linearised at;
  const Pose near(expSo3(Vector3d(-0.2, 0.4, 0.1)), Vector3d(0.5, 0.0, 0.3));
  ASSERT_TRUE(sensor.linearise(anchor, theta, PoseMatrices(near), at));
  const Eigen::Matrix<double, 3, 6> seen =
      at.pose() * gauge::ofPose(near, kOrigin) + at.landmark * gauge::ofLandmark(anchor, theta, kOrigin);
  EXPECT_LT(seen.norm(), 1e-10 * at.pose().norm());
  const auto step = process_model::residual(kT_odom_camera, near, Pose());
  EXPECT_LT((step.last * gauge::ofPose(kT_odom_camera, kOrigin) + step.next * gauge::ofPose(near, kOrigin)).norm(),
            1e-12);
}

TEST(Gauge, IsTransportedBetweenOrigins) {
  const Vector3d other(-3.0, 1.0, 2.0);
  EXPECT_LT(
      (gauge::ofPose(kT_odom_camera, other) * gauge::transport(kOrigin, other) - gauge::ofPose(kT_odom_camera, kOrigin))
          .norm(),
      1e-12);
}

}  // namespace
}  // namespace swf_vo
