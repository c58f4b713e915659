// SPDX-License-Identifier: BSD-3-Clause
#include "linear/block_matrix.hpp"

#include <algorithm>
#include <cstddef>

namespace pose_graph {

BlockPattern::BlockPattern(const Adjacency& graph, const Symbolic& shape) : symbolic(&shape) {
  row.reserve(graph.neighbours.size() / 2);
  first.reserve(shape.node.size() + 1);
  for (std::size_t k = 0; k < shape.node.size(); ++k) {
    const std::size_t node = static_cast<std::size_t>(shape.node[k]);
    for (int e = graph.first[node]; e < graph.first[node + 1]; ++e) {
      const int other = shape.place[static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(e)])];
      if (other > static_cast<int>(k)) row.push_back(other);
    }
    std::sort(row.begin() + first.back(), row.end());
    first.push_back(static_cast<int>(row.size()));
  }
}

BlockPattern::Slot BlockPattern::slot(int node_a, int node_b) const {
  const int a = symbolic->place[static_cast<std::size_t>(node_a)];
  const int b = symbolic->place[static_cast<std::size_t>(node_b)];
  const int column = std::min(a, b), wanted = std::max(a, b);
  const auto begin = row.begin() + first[static_cast<std::size_t>(column)];
  const auto end = row.begin() + first[static_cast<std::size_t>(column) + 1];
  const auto found = std::lower_bound(begin, end, wanted);
  if (found == end || *found != wanted) return {};
  return {static_cast<int>(found - row.begin()), a < b};
}

}  // namespace pose_graph
