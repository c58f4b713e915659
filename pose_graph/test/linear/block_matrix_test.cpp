// SPDX-License-Identifier: BSD-3-Clause
#include "linear/block_matrix.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/patterns.hpp"

namespace pose_graph {
namespace {

TEST(BlockMatrix, EachPairOfNeighboursHasItsPlace) {
  for (const test::NamedGraph& one : test::manyGraphs()) {
    const Symbolic symbolic = analyse(one.graph);
    const BlockPattern pattern(one.graph, symbolic);
    EXPECT_EQ(2 * pattern.row.size(), one.graph.neighbours.size()) << one.name;
    for (int a = 0; a < one.graph.size(); ++a)
      for (int e = one.graph.first[static_cast<std::size_t>(a)]; e < one.graph.first[static_cast<std::size_t>(a) + 1];
           ++e) {
        const int b = one.graph.neighbours[static_cast<std::size_t>(e)];
        const BlockPattern::Slot slot = pattern.slot(a, b), other = pattern.slot(b, a);
        EXPECT_EQ(slot.index, other.index);
        EXPECT_NE(slot.turned, other.turned);
        // The row is the later place; transposed if that is b's.
        const int place_a = symbolic.place[static_cast<std::size_t>(a)],
                  place_b = symbolic.place[static_cast<std::size_t>(b)];
        EXPECT_EQ(slot.turned, place_b > place_a);
        EXPECT_EQ(pattern.row[static_cast<std::size_t>(slot.index)], std::max(place_a, place_b));
      }
  }
}

TEST(BlockMatrix, UnconnectedOnesHaveNone) {
  const Adjacency chain = test::chainWithClosures(10, 0, 1);
  const Symbolic symbolic = analyse(chain);
  EXPECT_EQ(BlockPattern(chain, symbolic).slot(2, 7).index, -1);
}

}  // namespace
}  // namespace pose_graph
