// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/vocabulary/vocabulary.hpp"

#include <gtest/gtest.h>

#include "fabmap_node/vocabulary/k_means.hpp"
#include "support/synthetic_places.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

using testing::syntheticDescriptor;

std::vector<ByteDescriptor> descriptorsOfKinds(std::uint32_t kinds, std::uint32_t each) {
  std::vector<ByteDescriptor> all;
  for (std::uint32_t noise = 0; noise < each; ++noise)
    for (std::uint32_t kind = 0; kind < kinds; ++kind) all.push_back(syntheticDescriptor(kind, 1000 * kind + noise));
  return all;
}

TEST(Vocabulary, QuantisesAsASearchOfAllCentresWhereWordsAreFew) {
  const Vocabulary vocabulary(descriptorsOfKinds(40, 1));
  for (const ByteDescriptor& descriptor : descriptorsOfKinds(40, 5))
    EXPECT_EQ(vocabulary.quantise(descriptor), vocabulary.quantiseExactly(descriptor));
}

TEST(Vocabulary, QuantisesMostDescriptorsExactlyWhereWordsAreMany) {
  const Vocabulary vocabulary(descriptorsOfKinds(600, 1));
  int exact = 0, all = 0;
  for (const ByteDescriptor& descriptor : descriptorsOfKinds(600, 2)) {
    ++all;
    exact += vocabulary.quantise(descriptor) == vocabulary.quantiseExactly(descriptor) ? 1 : 0;
  }
  EXPECT_GT(exact, 0.9 * all);
}

TEST(Vocabulary, EqualCentresGiveTheFirstWord) {
  const Vocabulary vocabulary(std::vector<ByteDescriptor>(5, syntheticDescriptor(1, 1)));
  EXPECT_EQ(vocabulary.quantise(syntheticDescriptor(2, 2)), 0u);
}

TEST(Vocabulary, WordsAreAscendingAndUnique) {
  const Vocabulary vocabulary(descriptorsOfKinds(100, 1));
  const WordSet words = vocabulary.words(testing::syntheticPlace(3, 0));
  ASSERT_FALSE(words.empty());
  for (std::size_t i = 1; i < words.size(); ++i) EXPECT_LT(words[i - 1], words[i]);
}

TEST(TrainVocabulary, KeepsSeparateKindsApart) {
  KMeansOptions options;
  options.words = 60;
  const Vocabulary vocabulary = trainVocabulary(descriptorsOfKinds(30, 20), options);
  ASSERT_EQ(vocabulary.size(), 60u);
  std::vector<int> kind_of_word(60, -1);
  int shared = 0;
  for (std::uint32_t kind = 0; kind < 30; ++kind)
    for (std::uint32_t noise = 0; noise < 20; ++noise) {
      int& owner = kind_of_word[vocabulary.quantise(syntheticDescriptor(kind, 1000 * kind + noise))];
      if (owner < 0) owner = static_cast<int>(kind);
      shared += owner != static_cast<int>(kind) ? 1 : 0;
    }
  EXPECT_LE(shared, 60);  // of 600: two kinds without a centre may share a word
}

TEST(TrainVocabulary, DoesNotDependOnTheNumberOfThreads) {
  KMeansOptions options;
  options.words = 80;
  std::vector<std::vector<ByteDescriptor>> centres;
  for (const int threads : {1, 2}) {
    const urban_nav_core::ThreadLimit limit(threads);
    centres.push_back(trainVocabulary(descriptorsOfKinds(120, 6), options).centres());
  }
  EXPECT_EQ(centres[0], centres[1]);
}

TEST(TrainVocabulary, RefusesFewerDescriptorsThanWords) {
  KMeansOptions options;
  options.words = 10;
  EXPECT_THROW(trainVocabulary(descriptorsOfKinds(9, 1), options), urban_nav_core::UserError);
}

}  // namespace
}  // namespace fabmap_node
