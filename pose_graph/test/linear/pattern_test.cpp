// SPDX-License-Identifier: BSD-3-Clause
#include "linear/pattern.hpp"

#include <gtest/gtest.h>

namespace pose_graph {
namespace {

TEST(Pattern, NeighboursAreAscendingAndUnique) {
  const Adjacency graph = makeAdjacency(4, {{2, 0}, {0, 2}, {2, 0}, {1, 2}, {3, 3}, {-1, 2}, {0, -1}});
  EXPECT_EQ(graph.first, (std::vector<int>{0, 1, 2, 4, 4}));
  EXPECT_EQ(graph.neighbours, (std::vector<int>{2, 2, 0, 1}));
  EXPECT_EQ(graph.size(), 4);
}

TEST(Pattern, NothingAndLoneNodes) {
  EXPECT_EQ(makeAdjacency(0, {}).size(), 0);
  EXPECT_EQ(makeAdjacency(3, {}).first, (std::vector<int>{0, 0, 0, 0}));
}

}  // namespace
}  // namespace pose_graph
