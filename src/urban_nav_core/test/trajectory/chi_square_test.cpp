// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/chi_square.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_core {
namespace {

TEST(ChiSquare, OfTwoDegreesIsExponential) {
  for (const double x : {0.01, 0.5, 1.0, 3.0, 10.0, 50.0})
    EXPECT_NEAR(chiSquareProbability(x, 2), 1.0 - std::exp(-0.5 * x), 1e-14) << x;
}

TEST(ChiSquare, OfOneDegreeIsTheSquareOfANormal) {
  for (const double z : {0.1, 1.0, 1.96, 3.0})
    EXPECT_NEAR(chiSquareProbability(z * z, 1), std::erf(z / std::sqrt(2.0)), 1e-14) << z;
}

TEST(ChiSquare, AgreesWithTables) {
  EXPECT_NEAR(chiSquareQuantile(0.95, 3), 7.814728, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.99, 6), 16.811894, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.005, 10), 2.155856, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.5, 100), 99.334129, 1e-6);
}

TEST(ChiSquare, QuantileUndoesProbability) {
  for (const double dof : {0.5, 1.0, 6.0, 300.0, 6000.0, 1e6}) {
    for (const double p : {1e-6, 0.005, 0.5, 0.995, 1.0 - 1e-6})
      EXPECT_NEAR(chiSquareProbability(chiSquareQuantile(p, dof), dof), p, 1e-9) << dof;
  }
}

TEST(ChiSquare, BandOfFiftyRunsInSixDimensions) {
  const Band band = chiSquareMeanBand(6, 50, 0.99);
  EXPECT_NEAR(band.low, 4.81, 0.005);
  EXPECT_NEAR(band.high, 7.34, 0.005);
  EXPECT_TRUE(band.contains(6.0));
  EXPECT_FALSE(band.contains(7.5));
  EXPECT_FALSE(band.contains(std::nan("")));
}

TEST(ChiSquare, IsZeroBelowZero) {
  EXPECT_EQ(chiSquareProbability(0.0, 3), 0.0);
  EXPECT_EQ(chiSquareProbability(-1.0, 3), 0.0);
}

}  // namespace
}  // namespace urban_nav_core
