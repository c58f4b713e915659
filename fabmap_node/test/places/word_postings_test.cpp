// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/places/word_postings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "urban_nav_core/testing/dice.hpp"

namespace fabmap_node {
namespace {

constexpr std::size_t kPostingWords = 40;

/// Word q is in a share of q / 40 of the places, from rare to nearly all.
std::vector<WordSet> drawPlaces(std::size_t count) {
  urban_nav_core::testing::Dice dice(11);
  std::vector<WordSet> places(count);
  for (WordSet& place : places)
    for (Word q = 0; q < kPostingWords; ++q)
      if (dice.chance(static_cast<double>(q) / kPostingWords)) place.push_back(q);
  return places;
}

double sumWeights(const WordSet& place, const std::vector<WeightedWord>& weighted) {
  double sum = 0.0;
  for (const WeightedWord& each : weighted)
    if (std::binary_search(place.begin(), place.end(), each.word)) sum += each.weight;
  return sum;
}

TEST(WordPostings, AddsTheWeightsOfTheWordsOfEachPlaceAtEverySize) {
  const std::vector<WordSet> places = drawPlaces(9000);
  const std::vector<WeightedWord> rare = {{1, 0.5}, {2, -1.0}}, frequent = {{30, 0.25}, {39, 2.0}},
                                  both = {{0, 3.0}, {4, 0.125}, {5, 1.0}, {20, -0.3}, {38, 7.0}};
  std::vector<WeightedWord> most;
  for (Word q = 1; q < kPostingWords; q += 2) most.push_back({q, 0.1 * q - 2.0});
  WordPostings postings(kPostingWords);
  std::vector<double> sums;
  for (std::size_t i = 0; i < places.size(); ++i) {
    postings.add(places[i]);
    ASSERT_EQ(postings.size(), i + 1);
    if (i % 2000 != 0 && i + 1 != places.size() && i != 4094 && i != 4095) continue;
    for (const auto& weighted : {rare, frequent, both, most, std::vector<WeightedWord>()}) {
      sums.assign(postings.size(), 1.0);
      postings.addWeights(weighted, sums);
      for (std::size_t k = 0; k <= i; ++k) ASSERT_NEAR(sums[k], 1.0 + sumWeights(places[k], weighted), 1e-12) << k;
    }
  }
}

TEST(WordPostings, PlacesWithoutWordsCount) {
  WordPostings postings(kPostingWords);
  for (int i = 0; i < 5000; ++i) postings.add({});
  std::vector<double> sums(postings.size(), 0.5);
  postings.addWeights({{3, 1.0}}, sums);
  EXPECT_EQ(std::count(sums.begin(), sums.end(), 0.5), 5000);
}

}  // namespace
}  // namespace fabmap_node
