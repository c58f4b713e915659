// SPDX-License-Identifier: BSD-3-Clause
#include "linear/symbolic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "linear/index.hpp"
#include "support/patterns.hpp"

namespace pose_graph {
namespace {

std::set<int> listRows(const Symbolic& shape, int s) {
  return {shape.rows.begin() + shape.row_begin[sz(s)], shape.rows.begin() + shape.row_begin[sz(s) + 1]};
}

void expectSound(const Adjacency& graph, const Symbolic& shape) {
  const int n = graph.size();
  ASSERT_EQ(static_cast<int>(shape.node.size()), n);
  ASSERT_EQ(static_cast<int>(shape.place.size()), n);
  for (int i = 0; i < n; ++i) EXPECT_EQ(shape.node[sz(shape.place[sz(i)])], i);
  ASSERT_EQ(shape.begin.front(), 0);
  ASSERT_EQ(shape.begin.back(), n);
  ASSERT_EQ(static_cast<int>(shape.parent.size()), shape.size());
  std::vector<int> smallest(sz(shape.size()));  // smallest place of each subtree
  for (int s = 0; s < shape.size(); ++s) {
    ASSERT_GT(shape.columns(s), 0);
    for (int k = shape.begin[sz(s)]; k < shape.begin[sz(s) + 1]; ++k) EXPECT_EQ(shape.supernode[sz(k)], s);
    const auto first = shape.rows.begin() + shape.row_begin[sz(s)],
               last = shape.rows.begin() + shape.row_begin[sz(s) + 1];
    EXPECT_TRUE(std::is_sorted(first, last));
    EXPECT_EQ(std::adjacent_find(first, last), last);
    EXPECT_TRUE(first == last || *first >= shape.begin[sz(s) + 1]);
    // The parent contains the first row; the other rows are its columns or rows.
    if (first == last) {
      EXPECT_EQ(shape.parent[sz(s)], -1);
    } else {
      const int parent = shape.parent[sz(s)];
      ASSERT_GT(parent, s);
      EXPECT_EQ(parent, shape.supernode[sz(*first)]);
      const std::set<int> above = listRows(shape, parent);
      for (auto row = first; row != last; ++row)
        EXPECT_TRUE(above.count(*row) > 0 || shape.supernode[sz(*row)] == parent);
    }
  }
  // In postorder a subtree is the sequence of supernodes that ends at its root.
  std::vector<int> members(sz(shape.size()), 1);
  std::iota(smallest.begin(), smallest.end(), 0);
  for (int s = 0; s < shape.size(); ++s) {
    EXPECT_EQ(s - smallest[sz(s)] + 1, members[sz(s)]);
    if (shape.parent[sz(s)] < 0) continue;
    int& low = smallest[sz(shape.parent[sz(s)])];
    low = std::min(low, smallest[sz(s)]);
    members[sz(shape.parent[sz(s)])] += members[sz(s)];
  }
}

/// Every entry of the factor, found by explicit elimination, is within its supernode.
void expectHoldsFill(const Adjacency& graph, const Symbolic& shape) {
  const int n = graph.size();
  std::vector<std::set<int>> below(sz(n));
  for (int i = 0; i < n; ++i)
    for (int e = graph.first[sz(i)]; e < graph.first[sz(i) + 1]; ++e) {
      const int a = shape.place[sz(i)], b = shape.place[sz(graph.neighbours[sz(e)])];
      below[sz(std::min(a, b))].insert(std::max(a, b));
    }
  for (int k = 0; k < n; ++k) {
    const int s = shape.supernode[sz(k)];
    const std::set<int> rows = listRows(shape, s);
    for (const int row : below[sz(k)]) EXPECT_TRUE(shape.supernode[sz(row)] == s || rows.count(row) > 0);
    if (below[sz(k)].empty()) continue;
    const int next = *below[sz(k)].begin();
    below[sz(next)].insert(std::next(below[sz(k)].begin()), below[sz(k)].end());
  }
}

TEST(Symbolic, IsSoundForManyGraphs) {
  for (const test::NamedGraph& one : test::manyGraphs()) {
    SCOPED_TRACE(one.name);
    std::vector<int> given(sz(one.graph.size()));
    std::iota(given.begin(), given.end(), 0);
    for (const Symbolic& shape : {analyse(one.graph), analyse(one.graph, given)}) {
      expectSound(one.graph, shape);
      expectHoldsFill(one.graph, shape);
    }
  }
}

TEST(Symbolic, JoinsAChainIntoPieces) {
  const Symbolic shape = analyse(test::chainWithClosures(1000, 0, 1));
  EXPECT_LT(shape.size(), 600);
  // Merging must not add more zeros than entries: the factor of a chain has two entries per node.
  double entries = 0.0;
  for (int s = 0; s < shape.size(); ++s)
    entries +=
        0.5 * shape.columns(s) * (shape.columns(s) + 1.0) + static_cast<double>(shape.columns(s)) * shape.rowsBelow(s);
  EXPECT_LT(entries, 2.0 * 2000);
}

TEST(Symbolic, ACliqueIsOnePiece) {
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < i; ++j) pairs.emplace_back(i, j);
  EXPECT_EQ(analyse(makeAdjacency(12, pairs)).size(), 1);
}

}  // namespace
}  // namespace pose_graph
