// SPDX-License-Identifier: BSD-3-Clause
#include "world/day.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(Day, HasALowWarmSunAtDuskAndNoneAtNight) {
  for (const int number : {1, 2, 3, 4}) {
    const Day day = makeDay(7, number), dusk = makeDay(7, number, Light::Dusk),
              night = makeDay(7, number, Light::Night);
    EXPECT_NEAR(std::asin(dusk.to_sun.z()) * 180.0F / static_cast<float>(M_PI), 3.0F, 0.01F);
    EXPECT_NEAR(dusk.to_sun.norm(), 1.0F, 1e-5F);
    EXPECT_GT(dusk.sun.x(), 2.0F * dusk.sun.z());
    EXPECT_EQ(night.sun.maxCoeff(), 0.0F);
    EXPECT_GT(day.sky.minCoeff(), 10.0F * dusk.sky.maxCoeff());
    EXPECT_GT(dusk.sky.minCoeff(), 1000.0F * night.sky.maxCoeff());
    for (const Day& other : {dusk, night}) {
      EXPECT_EQ(other.wet, day.wet);
      EXPECT_EQ(other.leaves, day.leaves);
      EXPECT_EQ(other.clouds, day.clouds);
    }
  }
}

}  // namespace
}  // namespace urban_nav_sim
