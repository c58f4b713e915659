// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/passes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;

constexpr StampNs kTenth = 100'000'000;

/// Circles of 20 m radius at 1 m/s.
Trajectory circles(double rounds) {
  Trajectory trajectory;
  const double length = 2.0 * M_PI * 20.0;
  for (int i = 0; i < static_cast<int>(10.0 * rounds * length); ++i) {
    const double angle = 0.1 * i / 20.0;
    trajectory.append(i * kTenth, Pose(Eigen::Quaterniond::Identity(),
                                       Vector3d(20.0 * std::cos(angle), 20.0 * std::sin(angle), 0.0)));
  }
  return trajectory;
}

TEST(Passes, EachRoundIsOne) {
  const Trajectory four = circles(3.5);
  EXPECT_EQ(findPasses({&four}).front().begins.size(), 4U);
}

TEST(Passes, AStraightAndAStandingRobotHaveOne) {
  Trajectory straight, standing;
  for (int i = 0; i < 3000; ++i) {
    straight.append(i * kTenth, Pose(Eigen::Quaterniond::Identity(), Vector3d(0.1 * i, 0.0, 0.0)));
    standing.append(i * kTenth, Pose(Eigen::Quaterniond::Identity(), Vector3d(0.05 * (i % 2), 0.0, 0.0)));
  }
  EXPECT_EQ(findPasses({&straight}).front().begins.size(), 1U);
  EXPECT_EQ(findPasses({&standing}).front().begins.size(), 1U);
}

TEST(Passes, NumbersCountOnFromSessionToSession) {
  const Trajectory one = circles(0.5), empty;
  const auto passes = findPasses({&one, &empty, &one});
  EXPECT_EQ(passes[0].at(0), 0);
  EXPECT_TRUE(passes[1].begins.empty());
  EXPECT_EQ(passes[1].at(5), 0);
  EXPECT_EQ(passes[2].at(0), 1);
  EXPECT_EQ(passes[2].at(-1), 1) << "before the session: its first pass";
}

}  // namespace
}  // namespace laser_mapper
