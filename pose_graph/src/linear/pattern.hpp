// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

namespace pose_graph {

/// Which nodes of an undirected graph are neighbours: the pattern of a symmetric matrix of blocks, without its
/// diagonal. Neighbours of node i are neighbours[first[i]]...neighbours[first[i + 1] - 1], ascending, each once.
struct Adjacency {
  std::vector<int> first = {0};
  std::vector<int> neighbours;

  int size() const { return static_cast<int>(first.size()) - 1; }
};

/// Pairs may come twice and either way round; a pair of a node with itself, or with a negative node, is left out.
Adjacency makeAdjacency(int nodes, const std::vector<std::pair<int, int>>& pairs);

}  // namespace pose_graph
