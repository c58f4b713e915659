// SPDX-License-Identifier: BSD-3-Clause
#include "motion/spline_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/simulate_drive.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector3d;

// All six coordinates swing widely, so that no term of a derivative is small.
SplineMotion tumbling() {
  std::vector<Vector6> control;
  for (int i = 0; i < 60; ++i) {
    Vector6 point;
    for (int j = 0; j < 6; ++j) point[j] = 0.8 * std::sin(0.35 * (j + 1) * i + j);
    point[3] += 0.2 * i;
    control.push_back(point);
  }
  return {TimeSpline(-0.5, 0.1, control), 4.0};
}

TEST(SplineMotion, DerivativesAreThoseOfThePose) {
  const SplineMotion motion = tumbling();
  constexpr double kH = 1e-5;
  for (double t = 0.0; t < 4.0; t += 0.0531) {
    const MotionState before = motion.at(t - kH), now = motion.at(t), after = motion.at(t + kH);
    const auto near = [&](const Vector3d& low, const Vector3d& high, const Vector3d& rate) {
      return ((high - low) / (2 * kH) - rate).norm() < 1e-5 * (10.0 + rate.norm());
    };
    EXPECT_TRUE(near(before.T_world_base.t(), after.T_world_base.t(), now.velocity_world));
    EXPECT_TRUE(near(before.velocity_world, after.velocity_world, now.acceleration_world));
    EXPECT_TRUE(near(before.rate_base, after.rate_base, now.rate_change_base));
    const auto turned = before.T_world_base.q().conjugate() * after.T_world_base.q();
    EXPECT_TRUE(near(Vector3d::Zero(), urban_nav_core::logSo3(turned), now.rate_base));
  }
}

TEST(SplineMotion, BaseLinkHangsBelowTheAxle) {
  Vector6 still;
  still << 1.0, 2.0, kWheelRadius, 0.5, 0.1, 0.0;
  const SplineMotion motion(TimeSpline(0.0, 0.1, std::vector<Vector6>(8, still)), 0.3);
  const Vector3d p = motion.at(0.25).T_world_base.t();
  EXPECT_NEAR(p.z(), kWheelRadius * (1.0 - std::cos(0.1)), 1e-12);
  EXPECT_NEAR((p - Vector3d(1, 2, 0)).head<2>().norm(), kWheelRadius * std::sin(0.1), 1e-9);
}

}  // namespace
}  // namespace urban_nav_sim
