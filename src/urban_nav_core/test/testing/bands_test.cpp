// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/bands.hpp"

#include <random>

namespace urban_nav_core::testing {
namespace {

TEST(Bands, HoldChiSquareMeansAtTheirStatedRate) {
  std::mt19937 random(1);
  std::chi_squared_distribution<double> chi(6.0);
  int inside = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    double sum = 0.0;
    for (int i = 0; i < 50; ++i) sum += chi(random) / 50.0;
    inside += meanChiSquareFits(sum, 6, 50, 0.9) ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(inside) / kTrials, 0.9, 0.02);
}

TEST(Bands, StateTheExpectedBand) {
  EXPECT_TRUE(meanChiSquareFits(6.0, 6, 50));
  const auto result = meanChiSquareFits(9.0, 6, 50);
  EXPECT_FALSE(result);
  EXPECT_NE(std::string(result.message()).find("mean of 50 values is 9, expected 4.81"), std::string::npos)
      << result.message();
}

}  // namespace
}  // namespace urban_nav_core::testing
