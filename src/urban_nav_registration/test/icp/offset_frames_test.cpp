// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/icp/offset_frames.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/geometry/so3.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;

const CloudOffsets kOffsets{{691244.0, 5334577.0, 519.0}, {-30.0, 12.0, 4.0}};

Pose somePose() { return Pose(urban_nav_core::expSo3(Vector3d(0.1, -0.2, 0.7)), Vector3d(3.0, 1.0, -2.0)); }

TEST(OffsetFrames, PosesMapTheSamePoints) {
  const Pose T = somePose(), near = relativeToOffsets(T, kOffsets);
  for (const Vector3d& p : {Vector3d(1.0, 2.0, 3.0), Vector3d(691200.0, 5334500.0, 510.0)})
    EXPECT_LT((near * (p - kOffsets.source) + kOffsets.target - T * p).norm(), 1e-8);
  Alignment alignment;
  alignment.T_target_source = near;
  EXPECT_LT((toFileFrames(alignment, kOffsets).T_target_source.t() - T.t()).norm(), 1e-8);
}

TEST(OffsetFrames, CovarianceFollowsTheTangent) {
  const CloudOffsets offsets{{200.0, -50.0, 7.0}, {3.0, 2.0, 1.0}};
  Alignment alignment;
  alignment.T_target_source = somePose();
  const urban_nav_core::Matrix6d root = urban_nav_core::Matrix6d::Random();
  alignment.covariance = root * root.transpose() + urban_nav_core::Matrix6d::Identity();
  alignment.information = alignment.covariance.inverse();
  alignment.free_directions = {Vector6d::Unit(5)};
  const Alignment moved = toFileFrames(alignment, offsets);
  urban_nav_core::Matrix6d J;  // tangent (rho, phi) of the file's pose by that of the pose near the origin
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    const Vector6d d = kStep * Vector6d::Unit(i);
    Alignment other = alignment;
    other.T_target_source = Pose(urban_nav_core::expSo3(d.tail<3>()) * alignment.T_target_source.q(),
                                 alignment.T_target_source.t() + d.head<3>());
    const Pose T = toFileFrames(other, offsets).T_target_source;
    J.col(i) << (T.t() - moved.T_target_source.t()) / kStep,
        urban_nav_core::logSo3(T.q() * moved.T_target_source.q().conjugate()) / kStep;
  }
  EXPECT_LT((moved.covariance - J * alignment.covariance * J.transpose()).norm(), 1e-3 * moved.covariance.norm());
  EXPECT_LT((moved.information * moved.covariance - urban_nav_core::Matrix6d::Identity()).norm(), 1e-4);
  EXPECT_NEAR(std::abs(moved.free_directions[0].dot((J * Vector6d::Unit(5)).normalized())), 1.0, 1e-9);
}

}  // namespace
}  // namespace urban_nav_registration
