// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/model/chow_liu_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

using urban_nav_core::testing::Dice;

/// Words that copy an earlier word with some probability, so that the best tree is far from arbitrary.
WordSets drawDependentWords(std::size_t words, std::size_t observations, std::uint64_t seed) {
  Dice dice(seed);
  std::vector<std::size_t> source(words);
  std::vector<double> rate(words);
  for (std::size_t q = 0; q < words; ++q) {
    source[q] = q == 0 ? 0 : dice.below(q);
    rate[q] = dice.uniform(0.1, 0.6);
  }
  WordSets drawn{words, {}};
  for (std::size_t i = 0; i < observations; ++i) {
    std::vector<char> z(words);
    WordSet present;
    for (std::size_t q = 0; q < words; ++q) {
      z[q] = q > 0 && dice.chance(0.7) ? z[source[q]] : static_cast<char>(dice.chance(rate[q]));
      if (z[q] != 0) present.push_back(static_cast<Word>(q));
    }
    drawn.observations.push_back(present);
  }
  return drawn;
}

/// Returns the largest sum of weights over all labelled trees, by Prüfer's bijection.
double bestOfAllTrees(const std::vector<std::vector<double>>& weight) {
  const std::size_t n = weight.size();
  std::vector<std::size_t> code(n - 2, 0);
  double best = -1e9;
  while (true) {
    std::vector<int> degree(n, 1);
    for (const std::size_t q : code) ++degree[q];
    double sum = 0.0;
    const auto takeLeaf = [&degree, n] {
      for (std::size_t q = 0; q < n; ++q)
        if (degree[q] == 1) return q;
      return n;
    };
    for (const std::size_t q : code) {
      const std::size_t leaf = takeLeaf();
      sum += weight[leaf][q];
      degree[leaf] = 0;
      --degree[q];
    }
    const std::size_t one = takeLeaf();
    degree[one] = 0;
    best = std::max(best, sum + weight[one][takeLeaf()]);
    std::size_t digit = 0;
    while (digit < code.size() && ++code[digit] == n) code[digit++] = 0;
    if (digit == code.size()) return best;
  }
}

TEST(ChowLiuTree, IsTheBestOfAllTreesOfSevenWords) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const WordSets training = drawDependentWords(7, 60, seed);
    std::vector<std::vector<double>> weight(7, std::vector<double>(7));
    std::vector<std::size_t> single(7, 0);
    for (const WordSet& words : training.observations)
      for (const Word q : words) ++single[q];
    for (Word a = 0; a < 7; ++a)
      for (Word b = 0; b < 7; ++b) {
        std::size_t both = 0;
        for (const WordSet& words : training.observations)
          both +=
              std::binary_search(words.begin(), words.end(), a) && std::binary_search(words.begin(), words.end(), b);
        weight[a][b] = mutualInformation(both, single[a], single[b], training.observations.size());
      }
    const ChowLiuTree tree = learnChowLiuTree(training);
    checkTree(tree, "learnt");
    EXPECT_NEAR(totalInformation(tree, training), bestOfAllTrees(weight), 1e-12);
  }
}

TEST(ChowLiuTree, ProgressGrowsToOneAndChangesNothing) {
  WordSets training{1000, {}};
  for (Word i = 0; i < 40; ++i) training.observations.push_back({i, 100 + 2 * i, 900 + i});
  std::vector<double> shares;
  const ChowLiuTree tree = learnChowLiuTree(training, [&shares](double share) { shares.push_back(share); });
  EXPECT_EQ(tree.parent, learnChowLiuTree(training).parent);
  ASSERT_GE(shares.size(), 3u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
}

TEST(ChowLiuTree, ConditionalsAreSmoothedFrequenciesAndTheRootHasItsMarginal) {
  // Word 1 is present in three of four observations with word 0, and in none of one without.
  const WordSets training{2, {{0, 1}, {0, 1}, {0, 1}, {0}, {}}};
  const ChowLiuTree tree = learnChowLiuTree(training);
  EXPECT_EQ(tree.parent, (std::vector<Word>{0, 0}));
  EXPECT_DOUBLE_EQ(tree.p[0], 0.98 * 0.8 + 0.01);
  EXPECT_DOUBLE_EQ(tree.p_parent_present[0], tree.p[0]);
  EXPECT_DOUBLE_EQ(tree.p_parent_absent[0], tree.p[0]);
  EXPECT_DOUBLE_EQ(tree.p_parent_present[1], 0.98 * 0.75 + 0.01);
  EXPECT_DOUBLE_EQ(tree.p_parent_absent[1], 0.01);
}

TEST(ChowLiuTree, DoesNotDependOnTheOrderOfObservations) {
  WordSets training = drawDependentWords(40, 200, 9);
  const ChowLiuTree tree = learnChowLiuTree(training);
  std::reverse(training.observations.begin(), training.observations.end());
  EXPECT_EQ(learnChowLiuTree(training).parent, tree.parent);
}

TEST(ChowLiuTree, RefusesWordsBeyondTheVocabularyAndEmptyTraining) {
  EXPECT_THROW(learnChowLiuTree({2, {{0, 2}}}), urban_nav_core::UserError);
  EXPECT_THROW(learnChowLiuTree({2, {}}), urban_nav_core::UserError);
}

TEST(ChowLiuTree, CheckNamesCyclesRootsAndProbabilities) {
  const ChowLiuTree good{{0, 0, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
  EXPECT_NO_THROW(checkTree(good, "t"));
  const auto refused = [&good](const std::function<void(ChowLiuTree&)>& damage) {
    ChowLiuTree tree = good;
    damage(tree);
    try {
      checkTree(tree, "t");
    } catch (const urban_nav_core::UserError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused([](ChowLiuTree& t) { t.parent = {0, 2, 1}; }).find("cycle"), std::string::npos);
  EXPECT_NE(refused([](ChowLiuTree& t) { t.parent = {0, 1, 1}; }).find("2 roots"), std::string::npos);
  EXPECT_NE(refused([](ChowLiuTree& t) { t.parent[2] = 3; }).find("parent 3"), std::string::npos);
  EXPECT_NE(refused([](ChowLiuTree& t) { t.p[1] = 1.0; }).find("outside (0, 1)"), std::string::npos);
}

}  // namespace
}  // namespace fabmap_node
