// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

namespace pose_graph {

/// Adjacency of an undirected graph: the pattern of a symmetric block matrix without its diagonal. The neighbours of
/// node i are neighbours[first[i]]...neighbours[first[i + 1] - 1], ascending and unique.
struct Adjacency {
  std::vector<int> first = {0};
  std::vector<int> neighbours;

  int size() const { return static_cast<int>(first.size()) - 1; }
};

/// Builds the adjacency. Pairs may be repeated and in either order; pairs of equal or negative nodes are ignored.
Adjacency makeAdjacency(int nodes, const std::vector<std::pair<int, int>>& pairs);

}  // namespace pose_graph
