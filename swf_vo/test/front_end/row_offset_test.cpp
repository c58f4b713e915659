// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/row_offset.hpp"

#include <gtest/gtest.h>

#include <random>

namespace swf_vo {
namespace {

TEST(RowOffset, IsTheOffsetOfMostMatchesOfAFrame) {
  RowOffset rows(100);
  EXPECT_FALSE(rows.isKnown());
  for (int i = 0; i < 60; ++i) rows.see(0.7 + 0.01 * (i % 3 - 1));
  for (int i = 0; i < 25; ++i) rows.see(5.0);
  EXPECT_EQ(rows.px(), 0.0);
  rows.learn();
  EXPECT_TRUE(rows.isKnown());
  EXPECT_NEAR(rows.px(), 0.7, 0.011);
}

TEST(RowOffset, AFewMatchesAreNotUsed) {
  RowOffset rows(100);
  for (int i = 0; i < 10; ++i) rows.see(3.0);
  rows.learn();
  EXPECT_FALSE(rows.isKnown());
  EXPECT_EQ(rows.px(), 0.0);
}

TEST(RowOffset, GetsBetterWithFramesAndFollowsAMountThatMoves) {
  RowOffset rows(100);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.3);
  const auto frames = [&](int count, double offset) {
    for (int k = 0; k < count; ++k) {
      for (int i = 0; i < 50; ++i) rows.see(offset + noise(random));
      rows.learn();
    }
  };
  frames(100, -0.4);
  EXPECT_NEAR(rows.px(), -0.4, 0.02);
  frames(500, 0.2);
  EXPECT_NEAR(rows.px(), 0.2, 0.03);
}

TEST(RowOffset, TakesNoMoreThanItHasRoomFor) {
  RowOffset rows(30);
  for (int i = 0; i < 30; ++i) rows.see(1.0);
  for (int i = 0; i < 100; ++i) rows.see(9.0);
  rows.learn();
  EXPECT_EQ(rows.px(), 1.0);
}

}  // namespace
}  // namespace swf_vo
