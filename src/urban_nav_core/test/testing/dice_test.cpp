// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/dice.hpp"

#include <gtest/gtest.h>

#include <array>

#include "urban_nav_core/testing/bands.hpp"

namespace urban_nav_core::testing {
namespace {

TEST(Dice, DrawTheValuesOfTheStandard) {
  Dice dice(5489);  // its usual seed, of which ISO C++ [rand.predef] gives the 10 000th number
  double last = 0.0;
  for (int i = 0; i < 10000; ++i) last = dice.uniform();
  EXPECT_EQ(last, (static_cast<double>(9981545732273789042ULL >> 11) + 0.5) / 9007199254740992.0);
}

TEST(Dice, NormalNumbersAreNormal) {
  Dice dice(3);
  constexpr int kCount = 40000;
  double sum = 0.0, squares = 0.0, fourth = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double x = dice.normal();
    sum += x, squares += x * x, fourth += x * x * x * x;
  }
  EXPECT_TRUE(meanChiSquareFits(sum * sum / kCount, 1, 1));
  EXPECT_TRUE(meanChiSquareFits(squares / kCount, 1, kCount));
  EXPECT_NEAR(fourth / kCount, 3.0, 3.0 * std::sqrt(96.0 / kCount)) << "of variance 96 for one number";
}

TEST(Dice, EveryFaceComesUpAsOften) {
  Dice dice(4);
  std::array<int, 7> counts{};
  for (int i = 0; i < 7000; ++i) ++counts[dice.below(7)];
  double chi2 = 0.0;
  for (const int count : counts) chi2 += (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_TRUE(meanChiSquareFits(chi2, 6, 1));
  EXPECT_EQ(dice.below(1), 0u);
}

}  // namespace
}  // namespace urban_nav_core::testing
