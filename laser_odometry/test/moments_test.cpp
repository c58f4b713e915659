// SPDX-License-Identifier: BSD-3-Clause
#include "moments.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/dice.hpp"

namespace laser_odometry {
namespace {

using urban_nav_core::testing::Dice;

TEST(Moments, ThoseOfTwoOriginsAddUpToThoseOfAllPoints) {
  Dice dice(1);
  const Vector3d shift(3.0, -2.0, 5.0);
  Moments whole, part, other;
  for (int i = 0; i < 50; ++i) {
    const Vector3d p = dice.normals<3>();
    whole.add(p);
    if (i % 2 == 0) part.add(p);
    else other.add(p - shift);
  }
  part.add(other, shift);
  EXPECT_DOUBLE_EQ(part.count, whole.count);
  EXPECT_LT((part.mean() - whole.mean()).norm(), 1e-12);
  EXPECT_LT((part.covariance() - whole.covariance()).norm(), 1e-12);
}

TEST(Moments, ScalingKeepsMeanAndCovariance) {
  Dice dice(2);
  Moments moments;
  for (int i = 0; i < 20; ++i) moments.add(dice.normals<3>());
  Moments scaled = moments;
  scaled.scale(0.5);
  EXPECT_LT((scaled.mean() - moments.mean()).norm(), 1e-13);
  EXPECT_LT((scaled.covariance() - moments.covariance()).norm(), 1e-13);
}

TEST(Plane, NormalPositionAndThicknessAreThoseOfThePoints) {
  Dice dice(3);
  const Vector3d normal = Vector3d(1.0, 2.0, -0.5).normalized(), a = normal.unitOrthogonal(), b = normal.cross(a);
  const Vector3d origin(10.0, 20.0, 30.0), place(0.1, 0.2, 0.3);
  Moments moments;
  for (int i = 0; i < 4000; ++i)
    moments.add(place + dice.uniform(-0.5, 0.5) * a + dice.uniform(-0.5, 0.5) * b + 0.01 * dice.normal() * normal);
  const Plane plane = fitPlane(moments, origin);
  ASSERT_TRUE(plane.usable);
  EXPECT_GT(std::abs(plane.normal.dot(normal)), 1.0 - 1e-5);
  EXPECT_NEAR(plane.normal.dot(plane.mean - origin - place), 0.0, 0.001);
  EXPECT_NEAR(std::sqrt(plane.variance), 0.01, 0.001);
}

TEST(Plane, LinesBlobsAndFewPointsAreNotUsable) {
  Dice dice(4);
  Moments line, blob, few;
  for (int i = 0; i < 100; ++i) {
    line.add(Vector3d(dice.uniform(-0.5, 0.5), 0.01 * dice.normal(), 0.01 * dice.normal()));
    blob.add(dice.normals<3>());
  }
  for (int i = 0; i < 5; ++i) few.add(Vector3d(dice.uniform(), dice.uniform(), 0.0));
  Moments equal;
  for (int i = 0; i < 10; ++i) equal.add(Vector3d(1.0, 2.0, 3.0));
  for (const Moments& moments : {line, blob, few, equal}) EXPECT_FALSE(fitPlane(moments, Vector3d::Zero()).usable);
}

TEST(Moments, AWallIsFittedInThePlaneOfTheScan) {
  urban_nav_core::testing::Dice dice(4);
  const Vector3d origin(10.0, -3.0, 0.0), along(std::cos(0.6), std::sin(0.6), 0.0), normal(-along.y(), along.x(), 0.0);
  Moments moments;
  for (int i = 0; i < 400; ++i) moments.add(dice.uniform(-0.2, 0.2) * along + 0.01 * dice.normal() * normal);
  const Plane wall = fitWall(moments, origin);
  ASSERT_TRUE(wall.usable);
  EXPECT_GT(std::abs(wall.normal.dot(normal)), std::cos(4.0 * std::sqrt(wall.normal_variance)));
  EXPECT_EQ(wall.normal.z(), 0.0);
  EXPECT_NEAR(wall.variance, 1e-4, 2e-5);
  EXPECT_NEAR(wall.width, 0.4 * 0.4 / 12.0, 2e-3);
  EXPECT_NEAR(wall.normal.dot(wall.mean - origin), 0.0, 0.003);
  EXPECT_FALSE(isOutside(wall, origin + 0.2 * along));
  EXPECT_TRUE(isOutside(wall, origin + 0.4 * along));

  Moments corner, few;
  for (int i = 0; i < 200; ++i) corner.add(0.001 * i * (i % 2 == 0 ? along : normal));
  for (int i = 0; i < 5; ++i) few.add(0.1 * i * along);
  EXPECT_FALSE(fitWall(corner, origin).usable);
  EXPECT_FALSE(fitWall(few, origin).usable);
}

}  // namespace
}  // namespace laser_odometry
