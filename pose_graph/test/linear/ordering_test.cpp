// SPDX-License-Identifier: BSD-3-Clause
#include "linear/ordering.hpp"

#include <gtest/gtest.h>
#include <suitesparse/amd.h>

#include <algorithm>
#include <numeric>

#include "support/patterns.hpp"

namespace pose_graph {
namespace {

double work(const EliminationTree& tree) {
  return std::accumulate(tree.count.begin(), tree.count.end(), 0.0,
                         [](double sum, int count) { return sum + (count + 1.0) * (count + 1.0); });
}

/// Returns column counts and parents by explicit elimination, node after node.
EliminationTree plainTree(const Adjacency& graph, const std::vector<int>& order) {
  const std::size_t n = order.size();
  std::vector<std::vector<char>> filled(n, std::vector<char>(n, 0));
  std::vector<std::size_t> place(n);
  for (std::size_t k = 0; k < n; ++k) place[static_cast<std::size_t>(order[k])] = k;
  for (std::size_t i = 0; i < n; ++i)
    for (int e = graph.first[i]; e < graph.first[i + 1]; ++e)
      filled[place[i]][place[static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(e)])]] = 1;
  EliminationTree made{std::vector<int>(n, -1), std::vector<int>(n, 0)};
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = k + 1; i < n; ++i) {
      if (!filled[k][i]) continue;
      if (made.parent[k] < 0) made.parent[k] = static_cast<int>(i);
      ++made.count[k];
      for (std::size_t j = k + 1; j < n; ++j)
        if (j != i && filled[k][j]) filled[i][j] = filled[j][i] = 1;
    }
  return made;
}

TEST(Ordering, IsAPermutation) {
  for (const test::NamedGraph& one : test::manyGraphs()) {
    std::vector<int> all(static_cast<std::size_t>(one.graph.size()));
    std::iota(all.begin(), all.end(), 0);
    for (std::vector<int> order : {eliminationOrder(one.graph), minimumDegreeOrder(one.graph)}) {
      std::sort(order.begin(), order.end());
      EXPECT_EQ(order, all) << one.name;
    }
  }
}

TEST(Ordering, TreeIsThatOfPlainElimination) {
  for (const test::NamedGraph& one : test::manyGraphs()) {
    const std::vector<int> order = eliminationOrder(one.graph);
    std::vector<int> given(order.size());
    std::iota(given.begin(), given.end(), 0);
    for (const std::vector<int>& any : {order, given}) {
      const EliminationTree tree = eliminationTree(one.graph, any), plain = plainTree(one.graph, any);
      EXPECT_EQ(tree.parent, plain.parent) << one.name;
      EXPECT_EQ(tree.count, plain.count) << one.name;
    }
  }
}

TEST(Ordering, ChainsAndTreesFillNothing) {
  const Adjacency chain = test::chainWithClosures(500, 0, 1);
  const EliminationTree tree = eliminationTree(chain, eliminationOrder(chain));
  EXPECT_EQ(std::accumulate(tree.count.begin(), tree.count.end(), 0), 499);
}

TEST(Ordering, DissectsWhereThatPays) {
  const Adjacency cube = test::cubeGraph(16);
  std::vector<int> by_degree(static_cast<std::size_t>(cube.size()));
  ASSERT_GE(amd_order(cube.size(), cube.first.data(), cube.neighbours.data(), by_degree.data(), nullptr, nullptr), 0);
  const double least = work(eliminationTree(cube, by_degree));
  EXPECT_LT(work(eliminationTree(cube, eliminationOrder(cube))), 0.8 * least);
}

TEST(Ordering, IsTheSameEachTime) {
  const Adjacency cube = test::cubeGraph(12);
  EXPECT_EQ(eliminationOrder(cube), eliminationOrder(cube));
}

}  // namespace
}  // namespace pose_graph
