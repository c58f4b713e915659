// SPDX-License-Identifier: BSD-3-Clause
#include "noise/hash.hpp"

#include <gtest/gtest.h>

namespace urban_nav_sim {
namespace {

TEST(Hash, IsAFunctionOfEveryArgumentAndOfTheirOrder) {
  EXPECT_EQ(hash(1, 2, 3), hash(1, 2, 3));
  EXPECT_NE(hash(1, 2, 3), hash(1, 3, 2));
  EXPECT_NE(hash(1, 2, 3), hash(2, 2, 3));
  EXPECT_NE(hash(1, 2), hash(1, 2, 0));
}

TEST(Hash, DrawsAreUniformAndNormal) {
  const int n = 200000;
  Draw draw(7);
  double mean = 0.0, square = 0.0, normal_mean = 0.0, normal_square = 0.0, fourth = 0.0, product = 0.0, last = 0.0;
  for (int i = 0; i < n; ++i) {
    const double u = draw.uniform(), z = draw.normal();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    mean += u / n, square += u * u / n;
    normal_mean += z / n, normal_square += z * z / n, fourth += z * z * z * z / n, product += z * last / n;
    last = z;
  }
  EXPECT_NEAR(mean, 0.5, 0.003);
  EXPECT_NEAR(square, 1.0 / 3.0, 0.003);
  EXPECT_NEAR(normal_mean, 0.0, 0.01);
  EXPECT_NEAR(normal_square, 1.0, 0.015);
  EXPECT_NEAR(fourth, 3.0, 0.12);
  EXPECT_NEAR(product, 0.0, 0.01);
}

}  // namespace
}  // namespace urban_nav_sim
