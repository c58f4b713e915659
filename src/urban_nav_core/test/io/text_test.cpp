// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/text.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace urban_nav_core
