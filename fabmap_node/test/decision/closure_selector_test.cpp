// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/decision/closure_selector.hpp"

#include <gtest/gtest.h>

#include "fabmap_node/decision/travelled_distance.hpp"

namespace fabmap_node {
namespace {

TEST(ClosureSelector, RefusesWhatIsUnlikely) {
  ClosureSelector selector{Parameters()};
  EXPECT_FALSE(selector.select({0, 0.0}, {0, 100.0}, 0.05));
  EXPECT_TRUE(selector.select({0, 0.0}, {0, 100.0}, 0.06));
}

TEST(ClosureSelector, ProposesAtMostSoManyPerMetre) {
  Parameters parameters;
  parameters.enough_closures = 1000.0;
  ClosureSelector selector(parameters);
  int proposed = 0;
  for (int i = 0; i < 1000; ++i) proposed += selector.select({0, 0.0}, {0, 100.0 + 0.01 * i}, 1.0) ? 1 : 0;
  EXPECT_LE(proposed, 33);
  EXPECT_GE(proposed, 30);
}

TEST(ClosureSelector, LeavesWellConnectedStretchesAlone) {
  Parameters parameters;
  parameters.closures_per_metre = 1000.0;
  ClosureSelector selector(parameters);
  int proposed = 0;
  for (int i = 0; i < 50; ++i) proposed += selector.select({0, 1.0}, {1, 0.1 * i}, 0.99) ? 1 : 0;
  EXPECT_EQ(proposed, 3);
  EXPECT_TRUE(selector.select({0, 1.0}, {1, 5.5}, 0.99)) << "another stretch";
  EXPECT_TRUE(selector.select({0, 7.0}, {1, 5.6}, 0.99)) << "another place";
}

TEST(ClosureSelector, TriesSimilarStretchesAFewTimesOnly) {
  Parameters parameters;
  parameters.closures_per_metre = 1000.0;
  ClosureSelector selector(parameters);
  int proposed = 0;
  for (int i = 0; i < 40; ++i) proposed += selector.select({0, 1.0}, {1, 0.1 * i}, 0.1 + 0.001 * (i % 3)) ? 1 : 0;
  EXPECT_EQ(proposed, 3) << "probabilities are small singly and in sum";
  EXPECT_FALSE(selector.select({0, 1.0}, {1, 4.1}, 0.15));
  EXPECT_TRUE(selector.select({0, 1.0}, {1, 4.2}, 0.3)) << "clearly more probable than all previous ones";
  EXPECT_FALSE(selector.select({0, 1.0}, {1, 4.3}, 0.3));
}

TEST(ClosureSelector, StretchesWithoutAnythingKnownProposeLittle) {
  Parameters parameters;
  parameters.closures_per_metre = 1000.0;
  ClosureSelector selector(parameters);
  int proposed = 0;
  for (int i = 0; i < 40; ++i) proposed += selector.select({0, 37.0 * i}, {1, 0.1 * i}, 0.2) ? 1 : 0;
  EXPECT_EQ(proposed, 3) << "another place each time, all improbable";
  EXPECT_TRUE(selector.select({0, 2000.0}, {1, 4.5}, 0.9)) << "probable ones are not limited by them";
  EXPECT_TRUE(selector.select({0, 2100.0}, {1, 5.5}, 0.2)) << "another stretch";
}

TEST(TravelledDistance, InterpolatesAndIgnoresWhatIsOutOfOrder) {
  TravelledDistance travelled;
  EXPECT_EQ(travelled.at(5), 0.0);
  travelled.add(10, {0, 0, 0});
  travelled.add(20, {3, 4, 0});
  travelled.add(15, {100, 0, 0});
  travelled.add(30, {3, 4, 1});
  EXPECT_EQ(travelled.at(5), 0.0);
  EXPECT_DOUBLE_EQ(travelled.at(15), 2.5);
  EXPECT_DOUBLE_EQ(travelled.at(30), 6.0);
  EXPECT_DOUBLE_EQ(travelled.at(99), 6.0);
}

}  // namespace
}  // namespace fabmap_node
