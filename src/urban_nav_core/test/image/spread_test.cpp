// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/spread.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace urban_nav_core {
namespace {

TEST(Spread, NoNodeEverHoldsMoreThanItMay) {
  Spread spread(640, 401, 100, 3, 1.5);
  EXPECT_EQ(spread.allowedAt(0), 100);
  EXPECT_EQ(spread.allowedAt(1), 38);
  EXPECT_EQ(spread.allowedAt(2), 10);
  EXPECT_EQ(spread.allowedAt(3), 3);
  std::mt19937 random(1);
  std::normal_distribution<double> u(500.0, 90.0), v(100.0, 60.0);  // candidates crowd into one corner
  int added = 0;
  for (int i = 0; i < 5000; ++i) {
    const double u0 = u(random), v0 = v(random);
    if (!spread.mayAdd(u0, v0)) continue;
    spread.add(u0, v0);
    ++added;
    for (int depth = 0; depth <= spread.deepest(); ++depth) {
      ASSERT_LE(spread.countAt(u0, v0, depth), spread.allowedAt(depth));
    }
  }
  EXPECT_EQ(spread.count(), added);
  EXPECT_GT(added, 40);
  EXPECT_LE(added, 100);
}

TEST(Spread, CountsOfADepthAddUpToThoseAbove) {
  Spread spread(512, 384, 1000, 4, 2.0);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-0.5, 511.4), v(-0.5, 383.4);
  for (int i = 0; i < 300; ++i) spread.add(u(random), v(random));
  for (int depth = 0; depth <= 4; ++depth) {
    const int parts = 1 << depth;
    int sum = 0;
    for (int row = 0; row < parts; ++row) {
      for (int column = 0; column < parts; ++column) {
        sum += spread.countAt((column + 0.5) * 512 / parts - 0.5, (row + 0.5) * 384 / parts - 0.5, depth);
      }
    }
    EXPECT_EQ(sum, 300) << "depth " << depth;
  }
}

TEST(Spread, WhatIsTrackedIsCountedButNotTurnedAway) {
  Spread spread(100, 100, 2, 0, 1.0);
  for (int i = 0; i < 5; ++i) spread.add(10.0, 10.0);
  EXPECT_EQ(spread.count(), 5);
  EXPECT_FALSE(spread.mayAdd(90.0, 90.0));
  for (int i = 0; i < 4; ++i) spread.remove(10.0, 10.0);
  EXPECT_TRUE(spread.mayAdd(90.0, 90.0));
  spread.clear();
  EXPECT_EQ(spread.count(), 0);
}

TEST(Spread, PartsMeetWithoutGapAtOddSizes) {
  Spread spread(7, 5, 50, 2, 1.0);
  for (int v = 0; v < 5; ++v) {
    for (int u = 0; u < 7; ++u) spread.add(u, v);
  }
  EXPECT_EQ(spread.count(), 35);
  EXPECT_FALSE(spread.mayAdd(7.0, 2.0));
  EXPECT_FALSE(spread.mayAdd(-1.0, 2.0));
  EXPECT_FALSE(spread.mayAdd(std::numeric_limits<double>::quiet_NaN(), 2.0));
  spread.add(7.0, 2.0);
  EXPECT_EQ(spread.count(), 35);
}

}  // namespace
}  // namespace urban_nav_core
