// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace urban_nav_core {
namespace {

TEST(Text, WordsAreJoinedWithCommas) {
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({"vo"}), "vo");
  EXPECT_EQ(joined({"vo", "loops", "graph"}), "vo, loops, graph");
  EXPECT_EQ(joined({"", "b", ""}), ", b, ");
}

TEST(Text, EndIsComparedByItsOwnLength) {
  EXPECT_TRUE(endsWith("left.pgm", ".pgm"));
  EXPECT_TRUE(endsWith("left.pgm", "left.pgm"));
  EXPECT_TRUE(endsWith("left.pgm", ""));
  EXPECT_FALSE(endsWith("left.pgm", ".png"));
  EXPECT_FALSE(endsWith("pgm", ".pgm"));
}

TEST(Text, NumbersInNamesCountByTheirValue) {
  const std::vector<std::string> sorted = {"1.jpg",  "2.jpg",   "10.jpg",  "a01.png",
                                           "a1.png", "a1b.png", "a02.png", "b.png"};
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t j = 0; j < sorted.size(); ++j)
      EXPECT_EQ(isNaturallyLess(sorted[i], sorted[j]), i < j) << sorted[i] << " " << sorted[j];
  EXPECT_FALSE(isNaturallyLess("00", "00"));
  EXPECT_TRUE(isNaturallyLess("99999999999999999999", "100000000000000000000"));
}

}  // namespace
}  // namespace urban_nav_core
