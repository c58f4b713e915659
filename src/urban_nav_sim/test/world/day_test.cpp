// SPDX-License-Identifier: BSD-3-Clause
#include "world/day.hpp"

#include <gtest/gtest.h>

namespace urban_nav_sim {
namespace {

TEST(Day, IsPossibleWeatherAndTheSameAgain) {
  bool wet = false, bare = false;
  for (int number = 1; number <= 24; ++number) {
    const Day day = makeDay(7, number), again = makeDay(7, number);
    EXPECT_EQ(day.to_sun, again.to_sun);
    EXPECT_NEAR(day.to_sun.norm(), 1.0F, 1e-5F);
    EXPECT_GT(day.to_sun.z(), 0.4F);
    EXPECT_GT(day.sun.minCoeff(), 0.0F);
    EXPECT_LT(day.sun.maxCoeff(), 1.0F);
    EXPECT_GE(day.clouds, 0.0F);
    EXPECT_LE(day.clouds, 1.0F);
    wet |= day.wet > 0.0F, bare |= day.leaves < 0.5F;
  }
  EXPECT_TRUE(wet && bare);
}

TEST(Day, TheFirstIsFineAndTheNextIsOther) {
  for (const std::uint32_t seed : {1U, 7U, 8U}) {
    const Day first = makeDay(seed, 1), second = makeDay(seed, 2);
    EXPECT_EQ(first.wet, 0.0F);
    EXPECT_EQ(first.leaves, 1.0F);
    EXPECT_LT(first.to_sun.dot(second.to_sun), 0.95F);
  }
}

}  // namespace
}  // namespace urban_nav_sim
