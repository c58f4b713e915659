// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/pair_thinning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace urban_nav_live {
namespace {

constexpr double kCapacity = 200.0;

/// Pairs of a camera that a stage keeps, which needs `cost` periods of the camera for each pair.
struct ThinnedStream {
  std::vector<int> kept;
  double largest_backlog = 0.0;
};

/// `inputs`: messages per pair, which wait in a queue of kCapacity messages.
ThinnedStream thinnedStream(int pairs, double cost, double inputs) {
  PairThinning thinning;
  ThinnedStream run;
  double now = 0.0;  // periods of the camera
  for (int pair = 0; pair < pairs; ++pair) {
    now = std::max(now, static_cast<double>(pair));
    const double backlog = inputs * (now - pair) / kCapacity;
    run.largest_backlog = std::max(run.largest_backlog, backlog);
    if (!thinning.keeps(backlog)) continue;
    run.kept.push_back(pair);
    now += cost;
  }
  return run;
}

std::vector<int> spacings(const ThinnedStream& run, int from) {
  std::vector<int> found;
  for (std::size_t i = 1; i < run.kept.size(); ++i)
    if (run.kept[i - 1] >= from) found.push_back(run.kept[i] - run.kept[i - 1]);
  return found;
}

TEST(PairThinning, KeepsEachPairOfAStageThatKeepsUp) { EXPECT_EQ(thinnedStream(1000, 0.95, 10.0).kept.size(), 1000u); }

TEST(PairThinning, SkipsAtMostEverySecondPairOfAStageThatIsUpToTwiceTooSlow) {
  const ThinnedStream run = thinnedStream(1000, 1.8, 10.0);
  EXPECT_LT(run.largest_backlog, 1.0);
  EXPECT_NEAR(static_cast<double>(run.kept.size()), 1000.0 / 1.8, 30.0);
  for (const int spacing : spacings(run, 0)) EXPECT_LE(spacing, 2);
}

// The quarter of the queue above kFull holds the inputs of five periods.
TEST(PairThinning, SpacesThePairsOfASlowerStageEvenlyAndNeverFillsTheQueue) {
  for (const double cost : {2.5, 3.4, 4.9}) {
    const ThinnedStream run = thinnedStream(2000, cost, 10.0);
    EXPECT_LT(run.largest_backlog, 1.0) << cost;
    const std::vector<int> found = spacings(run, 200);
    ASSERT_FALSE(found.empty());
    const auto [least, most] = std::minmax_element(found.begin(), found.end());
    EXPECT_LE(*most - *least, 3) << cost;
    EXPECT_NEAR(static_cast<double>(found.size()), 1800.0 / cost, 0.05 * 1800.0 / cost + 2.0) << cost;
  }
}

TEST(PairThinning, KeepsEachPairAgainAfterAPeak) {
  PairThinning thinning;
  EXPECT_TRUE(thinning.keeps(0.0));
  EXPECT_FALSE(thinning.keeps(0.9));
  EXPECT_TRUE(thinning.keeps(0.6));
  EXPECT_FALSE(thinning.keeps(0.3));
  EXPECT_TRUE(thinning.keeps(0.2));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(thinning.keeps(0.1));
}

}  // namespace
}  // namespace urban_nav_live
