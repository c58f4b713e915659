// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/places/place_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace fabmap_node {
namespace {

/// Observations are the more similar, the nearer the remainders of their numbers.
double similarByRemainder(std::size_t a, std::size_t b) {
  const auto remainder = [](std::size_t i) { return static_cast<double>(i % 100); };
  return 1.0 / (1.0 + std::abs(remainder(a) - remainder(b)));
}

TEST(PlaceGroups, APlaceTakesInWhatIsConfirmed) {
  PlaceGroups groups;
  EXPECT_TRUE(groups.empty());
  EXPECT_TRUE(groups.appearances(3).empty());
  groups.confirm({3, 40, 0.5}, similarByRemainder);
  groups.confirm({40, 70, 0.5}, similarByRemainder);  // by another of its appearances
  const std::vector<std::size_t> all = {3, 40, 70};
  for (const std::size_t each : all) EXPECT_EQ(groups.appearances(each), all);
  EXPECT_TRUE(groups.appearances(4).empty());
}

TEST(PlaceGroups, DoNotDriftAlongChainsOfNeighbours) {
  PlaceGroups groups;
  for (std::size_t i = 0; i < 10; ++i) groups.confirm({i, i + 1, 0.9 * PlaceGroups::kReach}, similarByRemainder);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_LE(groups.appearances(i).size(), 2U) << i;
  groups.confirm({50, 60, 1.1 * PlaceGroups::kReach}, similarByRemainder);
  EXPECT_TRUE(groups.appearances(50).empty());
}

TEST(PlaceGroups, KeepEightThatDifferHoweverOftenAPlaceIsSeen) {
  PlaceGroups groups;
  // A hundred visits; those of a decade are similar.
  for (std::size_t visit = 1; visit <= 100; ++visit)
    groups.confirm({0, 1000 * visit + 10 * (visit % 10) + visit / 10 % 3, 0.1}, similarByRemainder);
  const std::vector<std::size_t>& kept = groups.appearances(0);
  ASSERT_EQ(kept.size(), PlaceGroups::kMostAppearances);
  EXPECT_EQ(kept.front(), 0U) << "the first observation is never forgotten";
  std::set<std::size_t> decades;
  for (const std::size_t each : kept) {
    EXPECT_FALSE(groups.isForgotten(each));
    decades.insert(each % 100 / 10);
  }
  EXPECT_EQ(decades.size(), kept.size()) << "no two of them are similar";
  EXPECT_TRUE(groups.isForgotten(1000 * 100 + 1)) << "the last of many similar ones";
}

TEST(PlaceGroups, ForgetWhatAWithdrawnPairBrought) {
  PlaceGroups groups, never;
  for (std::size_t i = 1; i <= 12; ++i) {
    groups.confirm({0, 100 * i + 7 * i, 0.1}, similarByRemainder);
    if (i != 3) never.confirm({0, 100 * i + 7 * i, 0.1}, similarByRemainder);
  }
  groups.withdraw(0, 321, similarByRemainder);
  EXPECT_EQ(groups.appearances(0), never.appearances(0));
  EXPECT_TRUE(groups.appearances(321).empty());
  EXPECT_FALSE(groups.isForgotten(321));
}

}  // namespace
}  // namespace fabmap_node
