// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/free_space_comparison.hpp"

#include <gtest/gtest.h>

#include <random>

namespace urban_nav_trust {
namespace {

/// Places with 200 walls; each exceeds the share of sound places with the probability `exceeding`.
std::vector<PlaceVisits> visit(unsigned seed, int places, double exceeding) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<PlaceVisits> all;
  for (int i = 0; i < places; ++i) {
    const double share = uniform(random) < exceeding ? 0.4 : 0.1 * uniform(random);
    all.push_back({{i, 100 + i}, 200.0 * (1.0 - share), 200.0 * share});
  }
  return all;
}

ConsistencyTest testPlaces(const std::vector<PlaceVisits>& places) {
  TestResults results;
  testFreeSpace(places, "", results);
  EXPECT_EQ(results.tests.size(), 1U);
  EXPECT_FALSE(confirm(results).isComplete());
  return results.tests.empty() ? ConsistencyTest() : results.tests[0];
}

TEST(FreeSpaceComparison, PValuesOfSoundPlacesAreAtLeastUniform) {
  for (const int places : {1, 3, 12}) {
    int below = 0;
    constexpr int kMaps = 5000;
    for (unsigned seed = 1; seed <= kMaps; ++seed) {
      const double p = testPlaces(visit(seed, places, kExceeding)).p_value;
      below += p < 0.01 ? 1 : 0;
      EXPECT_GT(p, 1e-5) << places << ", " << seed;
    }
    EXPECT_LE(below, 68) << places;  // 99 % of a binomial variable with 5000 and 0.01
  }
}

TEST(FreeSpaceComparison, OneMovedTruckIsNoFault) {
  for (const int places : {1, 2, 8}) {
    std::vector<PlaceVisits> all = visit(1, places, 0.0);
    all[0].contradicted = all[0].confirmed = 100.0;
    EXPECT_GT(testPlaces(all).p_value, 1e-3) << places;
  }
}

TEST(FreeSpaceComparison, VisitsThatAreNotJoinedFail) {
  std::vector<PlaceVisits> all = visit(2, 8, 0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    all[i].confirmed = 80.0;
    all[i].contradicted = 120.0;
  }
  const ConsistencyTest test = testPlaces(all);
  EXPECT_LT(test.p_value, 1e-5);
  EXPECT_EQ(test.interval.from, 0);
  EXPECT_EQ(test.interval.to, 103);
  EXPECT_NE(test.sentence.find("4 of 8"), std::string::npos) << test.sentence;
  EXPECT_NE(test.sentence.find("60 %"), std::string::npos) << test.sentence;
  EXPECT_FALSE(test.remedy.empty());
}

TEST(FreeSpaceComparison, WithoutPlacesOrWallsItIsAbsent) {
  TestResults results;
  testFreeSpace({}, "no lasers", results);
  testFreeSpace({{{0, 1}, 5.0, 5.0}, {{0, 1}, 0.0, 0.0}}, "no lasers", results);
  EXPECT_TRUE(results.tests.empty());
  ASSERT_EQ(results.absent.size(), 2U);
  EXPECT_EQ(results.absent[0].reason, "no lasers");
  EXPECT_NE(results.absent[1].reason.find("too few walls"), std::string::npos);
}

}  // namespace
}  // namespace urban_nav_trust
