// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/places/place_index.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_core/testing/dice.hpp"

namespace fabmap_node {
namespace {

using urban_nav_core::testing::Dice;

WordSets drawWords(std::size_t words, std::size_t observations, double density, std::uint64_t seed) {
  Dice dice(seed);
  WordSets drawn{words, {}};
  for (std::size_t i = 0; i < observations; ++i) {
    WordSet set;
    for (Word q = 0; q < words; ++q)
      if (dice.chance(density * (q % 3 == 0 ? 2.0 : 0.5))) set.push_back(q);
    drawn.observations.push_back(set);
  }
  return drawn;
}

struct Case {
  Detector detector;
  Dependence dependence;
};
const Case kCases[] = {
    {{0.39, 0.0}, Dependence::ChowLiu}, {{0.6, 0.05}, Dependence::ChowLiu}, {{0.39, 0.01}, Dependence::Naive}};

TEST(PlaceIndex, EqualsThePlainEvaluation) {
  const WordSets drawn = drawWords(150, 80, 0.1, 3);
  const ChowLiuTree tree = learnChowLiuTree(drawn);
  for (const Case& c : kCases) {
    const LikelihoodTable table(tree, c.detector, c.dependence);
    PlaceIndex index(table);
    for (const WordSet& place : drawn.observations) index.add(place);
    std::vector<double> logs;
    for (const WordSet& query : {drawn.observations[7], WordSet{}, WordSet{0, 149}}) {
      index.logLikelihoods(query, logs);
      ASSERT_EQ(logs.size(), drawn.observations.size());
      for (std::size_t i = 0; i < logs.size(); ++i)
        EXPECT_NEAR(logs[i], logLikelihoodPlain(table, query, drawn.observations[i]), 1e-9);
    }
  }
}

TEST(PlaceIndex, LargeMapsEqualThePlainEvaluation) {
  // More places than three blocks of postings.
  const WordSets drawn = drawWords(40, 7000, 0.1, 6);
  const LikelihoodTable table(learnChowLiuTree(drawn), {0.6, 0.05}, Dependence::ChowLiu);
  PlaceIndex index(table);
  std::vector<double> logs;
  for (std::size_t i = 0; i < drawn.observations.size(); ++i) {
    index.add(drawn.observations[i]);
    if (i % 1024 > 1 && i + 1 < drawn.observations.size()) continue;
    index.logLikelihoods(drawn.observations[5], logs);
    ASSERT_EQ(logs.size(), i + 1);
    for (std::size_t k = 0; k <= i; k += 97)
      EXPECT_NEAR(logs[k], logLikelihoodPlain(table, drawn.observations[5], drawn.observations[k]), 1e-9);
    EXPECT_NEAR(logs[i], logLikelihoodPlain(table, drawn.observations[5], drawn.observations[i]), 1e-9);
  }
}

TEST(Likelihood, OfAllQueriesAtOnePlaceSumsToOneWithoutTheTree) {
  // Naive Bayes is a normalised distribution over the 2^V queries; the tree's approximation is normalised per word
  // only.
  const WordSets drawn = drawWords(9, 60, 0.3, 5);
  const LikelihoodTable table(learnChowLiuTree(drawn), {0.6, 0.05}, Dependence::Naive);
  double at_place = 0.0, unknown = 0.0;
  for (unsigned bits = 0; bits < 512; ++bits) {
    WordSet query;
    for (Word q = 0; q < 9; ++q)
      if ((bits >> q & 1u) != 0) query.push_back(q);
    at_place += std::exp(logLikelihoodPlain(table, query, drawn.observations[0]));
    unknown += std::exp(logLikelihoodUnknown(table, query));
  }
  EXPECT_NEAR(at_place, 1.0, 1e-12);
  EXPECT_NEAR(unknown, 1.0, 1e-12);
}

TEST(Likelihood, FavoursThePlaceThatSharesWords) {
  const WordSets drawn = drawWords(60, 100, 0.2, 8);
  const LikelihoodTable table(learnChowLiuTree(drawn), {0.6, 0.02}, Dependence::ChowLiu);
  const WordSet& query = drawn.observations[4];
  for (std::size_t i = 0; i < drawn.observations.size(); ++i) {
    if (i == 4) continue;
    EXPECT_GT(logLikelihoodPlain(table, query, query), logLikelihoodPlain(table, query, drawn.observations[i]));
  }
}

}  // namespace
}  // namespace fabmap_node
