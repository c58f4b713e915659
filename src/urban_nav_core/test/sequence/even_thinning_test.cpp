// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/even_thinning.hpp"

#include <gtest/gtest.h>

namespace urban_nav_core {
namespace {

EvenThinning<int> thinned(std::size_t most, int length) {
  EvenThinning<int> thinning(most);
  for (int i = 0; i < length; ++i) thinning.add(i);
  return thinning;
}

TEST(EvenThinning, KeepsAllOfAShortSequence) {
  EXPECT_TRUE(thinned(4, 0).items().empty());
  EXPECT_EQ(thinned(4, 4).items(), (std::vector<int>{0, 1, 2, 3}));
}

TEST(EvenThinning, KeepsMoreThanHalfOfWhatItMayEvenlySpacedFromTheFirst) {
  for (const std::size_t most : {3U, 4U, 100U, 101U})
    for (int length = static_cast<int>(most) + 1; length < 1000; ++length) {
      const EvenThinning<int> thinning = thinned(most, length);
      const std::vector<int>& items = thinning.items();
      ASSERT_LE(items.size(), most) << length;
      ASSERT_GT(2 * items.size(), most) << length;
      EXPECT_EQ(items.front(), 0);
      const int step = items[1];
      for (std::size_t i = 0; i < items.size(); ++i) ASSERT_EQ(items[i], static_cast<int>(i) * step) << length;
      EXPECT_LT(length - 1 - items.back(), step) << length << ": reaches the end";
    }
}

}  // namespace
}  // namespace urban_nav_core
