// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/feature_quadtree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace urban_nav_core {
namespace {

TEST(FeatureQuadtree, NoNodeEverHoldsMoreThanItMay) {
  FeatureQuadtree quadtree(640, 401, 100, 3, 1.5);
  EXPECT_EQ(quadtree.allowedAt(0), 100);
  EXPECT_EQ(quadtree.allowedAt(1), 38);
  EXPECT_EQ(quadtree.allowedAt(2), 10);
  EXPECT_EQ(quadtree.allowedAt(3), 3);
  std::mt19937 random(1);
  std::normal_distribution<double> u(500.0, 90.0), v(100.0, 60.0);  // candidates crowd into one corner
  int added = 0;
  for (int i = 0; i < 5000; ++i) {
    const double u0 = u(random), v0 = v(random);
    if (!quadtree.mayAdd(u0, v0)) continue;
    quadtree.add(u0, v0);
    ++added;
    for (int depth = 0; depth <= quadtree.deepest(); ++depth) {
      ASSERT_LE(quadtree.countAt(u0, v0, depth), quadtree.allowedAt(depth));
    }
  }
  EXPECT_EQ(quadtree.count(), added);
  EXPECT_GT(added, 40);
  EXPECT_LE(added, 100);
}

TEST(FeatureQuadtree, CountsOfADepthAddUpToThoseAbove) {
  FeatureQuadtree quadtree(512, 384, 1000, 4, 2.0);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-0.5, 511.4), v(-0.5, 383.4);
  for (int i = 0; i < 300; ++i) quadtree.add(u(random), v(random));
  for (int depth = 0; depth <= 4; ++depth) {
    const int parts = 1 << depth;
    int sum = 0;
    for (int row = 0; row < parts; ++row) {
      for (int column = 0; column < parts; ++column) {
        sum += quadtree.countAt((column + 0.5) * 512 / parts - 0.5, (row + 0.5) * 384 / parts - 0.5, depth);
      }
    }
    EXPECT_EQ(sum, 300) << "depth " << depth;
  }
}

TEST(FeatureQuadtree, WhatIsTrackedIsCountedButNotTurnedAway) {
  FeatureQuadtree quadtree(100, 100, 2, 0, 1.0);
  for (int i = 0; i < 5; ++i) quadtree.add(10.0, 10.0);
  EXPECT_EQ(quadtree.count(), 5);
  EXPECT_FALSE(quadtree.mayAdd(90.0, 90.0));
  for (int i = 0; i < 4; ++i) quadtree.remove(10.0, 10.0);
  EXPECT_TRUE(quadtree.mayAdd(90.0, 90.0));
  quadtree.clear();
  EXPECT_EQ(quadtree.count(), 0);
}

TEST(FeatureQuadtree, PartsMeetWithoutGapAtOddSizes) {
  FeatureQuadtree quadtree(7, 5, 50, 2, 1.0);
  for (int v = 0; v < 5; ++v) {
    for (int u = 0; u < 7; ++u) quadtree.add(u, v);
  }
  EXPECT_EQ(quadtree.count(), 35);
  EXPECT_FALSE(quadtree.mayAdd(7.0, 2.0));
  EXPECT_FALSE(quadtree.mayAdd(-1.0, 2.0));
  EXPECT_FALSE(quadtree.mayAdd(std::numeric_limits<double>::quiet_NaN(), 2.0));
  quadtree.add(7.0, 2.0);
  EXPECT_EQ(quadtree.count(), 35);
}

}  // namespace
}  // namespace urban_nav_core
