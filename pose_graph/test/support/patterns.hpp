// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "linear/pattern.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace pose_graph::test {

/// A graph with a name for a failing test.
struct NamedGraph {
  std::string name;
  Adjacency graph;
};

inline Adjacency cubeGraph(int side) {
  std::vector<std::pair<int, int>> pairs;
  const auto at = [side](int x, int y, int z) { return (z * side + y) * side + x; };
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        if (x > 0) pairs.emplace_back(at(x, y, z), at(x - 1, y, z));
        if (y > 0) pairs.emplace_back(at(x, y, z), at(x, y - 1, z));
        if (z > 0) pairs.emplace_back(at(x, y, z), at(x, y, z - 1));
      }
  return makeAdjacency(side * side * side, pairs);
}

/// Returns a chain of `nodes` nodes with `closures` edges between any two.
inline Adjacency chainWithClosures(int nodes, int closures, std::uint64_t seed) {
  urban_nav_core::testing::Dice dice(seed);
  std::vector<std::pair<int, int>> pairs;
  for (int i = 1; i < nodes; ++i) pairs.emplace_back(i - 1, i);
  for (int i = 0; i < closures; ++i)
    pairs.emplace_back(static_cast<int>(dice.below(static_cast<std::size_t>(nodes))),
                       static_cast<int>(dice.below(static_cast<std::size_t>(nodes))));
  return makeAdjacency(nodes, pairs);
}

/// Returns chains, stars, cliques, unconnected parts, single nodes, an empty graph and random graphs.
inline std::vector<NamedGraph> manyGraphs() {
  using Pairs = std::vector<std::pair<int, int>>;
  std::vector<NamedGraph> made;
  made.push_back({"nothing", makeAdjacency(0, {})});
  made.push_back({"one", makeAdjacency(1, {})});
  made.push_back({"five alone", makeAdjacency(5, {})});
  made.push_back({"chain", chainWithClosures(60, 0, 1)});
  Pairs star, clique, parts;
  for (int i = 1; i < 30; ++i) star.emplace_back(7, i == 7 ? 0 : i);
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < i; ++j) clique.emplace_back(i, j);
  for (int i = 0; i < 40; ++i)
    if (i % 10 != 9) parts.emplace_back(i, i + 1);
  for (int i = 20; i < 30; ++i) parts.emplace_back(20, i);
  made.push_back({"star", makeAdjacency(30, star)});
  made.push_back({"clique", makeAdjacency(20, clique)});
  made.push_back({"parts", makeAdjacency(42, parts)});
  made.push_back({"cube", cubeGraph(5)});
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    made.push_back({"drawn " + std::to_string(seed),
                    chainWithClosures(30 + 10 * static_cast<int>(seed), 5 * static_cast<int>(seed * seed), seed)});
  return made;
}

}  // namespace pose_graph::test
