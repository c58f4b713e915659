// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/places/tf_idf_index.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fabmap_node {
namespace {

ChowLiuTree treeOfFrequencies(const std::vector<double>& frequencies) {
  ChowLiuTree tree;
  for (const double p : frequencies) {
    tree.parent.push_back(0);
    tree.p.push_back(p);
    tree.p_parent_present.push_back(p);
    tree.p_parent_absent.push_back(p);
  }
  return tree;
}

TEST(TfIdfIndex, EqualObservationsHaveSimilarityOneAndDisjointOnesZero) {
  TfIdfIndex index(treeOfFrequencies({0.5, 0.1, 0.2, 0.3, 0.05}));
  index.add({0, 1, 3});
  index.add({2, 4});
  index.add({});
  std::vector<double> similarities;
  index.similarities({0, 1, 3}, similarities);
  ASSERT_EQ(similarities.size(), 3u);
  EXPECT_NEAR(similarities[0], 1.0, 1e-15);
  EXPECT_EQ(similarities[1], 0.0);
  EXPECT_EQ(similarities[2], 0.0);
}

TEST(TfIdfIndex, SharedRareWordsWeighMoreThanSharedFrequentOnes) {
  TfIdfIndex index(treeOfFrequencies({0.9, 0.01, 0.3, 0.3}));
  index.add({0, 2});
  index.add({1, 3});
  std::vector<double> similarities;
  index.similarities({0, 1}, similarities);
  EXPECT_GT(similarities[1], 10.0 * similarities[0]);
  const double rare = std::log(0.01), other = std::log(0.3), frequent = std::log(0.9);
  EXPECT_NEAR(similarities[1], rare * rare / (std::hypot(rare, frequent) * std::hypot(rare, other)), 1e-12);
}

}  // namespace
}  // namespace fabmap_node
