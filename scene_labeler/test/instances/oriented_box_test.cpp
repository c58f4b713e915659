// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/instances/oriented_box.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scene_labeler {
namespace {

/// Outline of a rectangle of 4.2 m x 1.8 m at (3, -2); `sides`: of it, from the front clockwise.
std::vector<Eigen::Vector2d> outline(double heading, int sides) {
  std::vector<Eigen::Vector2d> points;
  const Eigen::Vector2d x(std::cos(heading), std::sin(heading)), y(-x.y(), x.x());
  const auto add = [&](double a, double b) { points.push_back(Eigen::Vector2d(3.0, -2.0) + a * x + b * y); };
  for (int i = 0; i <= 18; ++i) add(2.1, -0.9 + 0.1 * i);
  for (int i = 0; i <= 42; ++i) add(-2.1 + 0.1 * i, -0.9);
  if (sides < 4) return points;
  for (int i = 0; i <= 18; ++i) add(-2.1, -0.9 + 0.1 * i);
  for (int i = 0; i <= 42; ++i) add(-2.1 + 0.1 * i, 0.9);
  return points;
}

double angleBetween(double a, double b) { return std::abs(std::remainder(a - b, M_PI)); }

TEST(OrientedBox, IsThatOfARectangleOfWhichTwoSidesWereSeen) {
  for (const int sides : {2, 4})
    for (const double heading : {0.0, 0.3, 1.2, 1.5707, 2.4, 3.0}) {
      const OrientedBox box = fitBox(outline(heading, sides));
      EXPECT_NEAR((box.centre - Eigen::Vector2d(3.0, -2.0)).norm(), 0.0, 0.05) << heading;
      EXPECT_LT(angleBetween(box.heading, heading), 0.02) << heading;
      EXPECT_NEAR(box.length, 4.2, 0.1);
      EXPECT_NEAR(box.width, 1.8, 0.1);
      EXPECT_GE(box.heading, 0.0);
      EXPECT_LT(box.heading, M_PI);
      EXPECT_TRUE(box.holds(box.centre));
      EXPECT_FALSE(box.holds(box.centre + 1.2 * Eigen::Vector2d(-std::sin(heading), std::cos(heading))));
      EXPECT_TRUE(box.holds(box.centre + 1.2 * Eigen::Vector2d(-std::sin(heading), std::cos(heading)), 0.4));
    }
}

TEST(OrientedBox, OfFewPointsHasTheirExtent) {
  EXPECT_EQ(fitBox({}).length, 0.0);
  const OrientedBox one = fitBox({{5.0, 6.0}});
  EXPECT_EQ(one.length, 0.0);
  EXPECT_NEAR((one.centre - Eigen::Vector2d(5.0, 6.0)).norm(), 0.0, 1e-12);
  const OrientedBox two = fitBox({{0.0, 0.0}, {1.0, 1.0}});
  EXPECT_TRUE(two.holds({0.0, 0.0}, 1e-6));
  EXPECT_TRUE(two.holds({1.0, 1.0}, 1e-6));
}

}  // namespace
}  // namespace scene_labeler
