// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/trajectory.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "support/time.hpp"
#include "urban_nav_core/trajectory/interpolate.hpp"

namespace urban_nav_core {
namespace {

Trajectory corner() {
  Trajectory t;
  t.append(0, Pose());
  t.append(kSecond, Pose(Quaterniond::Identity(), {2, 0, 0}));
  t.append(3 * kSecond, Pose(expSo3({0, 0, 1.0}), {2, 4, 0}));
  return t;
}

TEST(Interpolate, GoesStraightAndTurnsAtConstantRate) {
  const Pose a(expSo3({0, 0, 0.2}), {1, 1, 0}), b(expSo3({0, 0, 1.2}), {3, 1, 0});
  EXPECT_TRUE(isApprox(interpolate(a, b, 0.25), Pose(expSo3({0, 0, 0.45}), {1.5, 1, 0}), 1e-15));
  EXPECT_TRUE(isApprox(interpolate(a, b, 1.5), Pose(expSo3({0, 0, 1.7}), {4, 1, 0}), 1e-15));
  EXPECT_TRUE(isApprox(interpolate(a, b, 0.0), a, 0.0));
  EXPECT_TRUE(isApprox(interpolate(a, b, 1.0), b, 0.0));
}

TEST(Interpolate, TakesTheShorterArc) {
  const Pose a(expSo3({0, 0, 3.0}), Vector3d::Zero()), b(expSo3({0, 0, -3.0}), Vector3d::Zero());
  EXPECT_NEAR(angleBetween(interpolate(a, b, 0.5), Pose(expSo3({0, 0, 3.14159265358979}), Vector3d::Zero())), 0.0,
              1e-12);
}

TEST(Trajectory, KeepsStampsRising) {
  Trajectory t = corner();
  EXPECT_FALSE(t.append(3 * kSecond, Pose()));
  EXPECT_FALSE(t.append(0, Pose()));
  EXPECT_EQ(t.size(), 3U);
}

TEST(Trajectory, InterpolatesBetweenItsPosesOnly) {
  const Trajectory t = corner();
  EXPECT_TRUE(isApprox(*t.at(kSecond / 2, kSecond), Pose(Quaterniond::Identity(), {1, 0, 0}), 1e-15));
  EXPECT_TRUE(isApprox(*t.at(2 * kSecond, 2 * kSecond), Pose(expSo3({0, 0, 0.5}), {2, 2, 0}), 1e-15));
  EXPECT_FALSE(t.at(2 * kSecond, kSecond)) << "the gap is two seconds";
  EXPECT_TRUE(t.at(3 * kSecond, kSecond)) << "a pose itself has no gap";
  EXPECT_FALSE(t.at(-1, kSecond));
  EXPECT_FALSE(t.at(3 * kSecond + 1, kSecond));
  EXPECT_FALSE(Trajectory().at(0, kSecond));
}

TEST(Trajectory, FindsTheNearest) {
  const Trajectory t = corner();
  EXPECT_EQ(t.nearest(-5), 0U);
  EXPECT_EQ(t.nearest(kSecond / 2), 0U);
  EXPECT_EQ(t.nearest(kSecond / 2 + 1), 1U);
  EXPECT_EQ(t.nearest(std::numeric_limits<StampNs>::max()), 2U);
}

TEST(Trajectory, HasALength) {
  EXPECT_EQ(corner().length(), 6.0);
  EXPECT_EQ(Trajectory().length(), 0.0);
}

TEST(Trajectory, MovesAsAWhole) {
  const Pose T(expSo3({0, 0, 1.0}), {1, 2, 3});
  const Trajectory moved = transformed(T, corner());
  EXPECT_TRUE(isApprox(moved[2].pose, T * corner()[2].pose, 0.0));
  EXPECT_NEAR(moved.length(), 6.0, 1e-14);
}

TEST(Trajectory, ComparesAndPrints) {
  Trajectory other = corner();
  EXPECT_TRUE(isApprox(corner(), other, 0.0));
  other.append(4 * kSecond, Pose());
  EXPECT_FALSE(isApprox(corner(), other, 1e9));
  EXPECT_FALSE(isApprox(corner(), transformed(Pose(Quaterniond::Identity(), {0.1, 0, 0}), corner()), 0.09));
  std::ostringstream out;
  out << corner() << " / " << Trajectory();
  EXPECT_EQ(out.str(), "3 poses from 0.000000000 to 3.000000000 s, 6 m / no poses");
}

}  // namespace
}  // namespace urban_nav_core
