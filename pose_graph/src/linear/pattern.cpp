// SPDX-License-Identifier: BSD-3-Clause
#include "linear/pattern.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace pose_graph {

Adjacency makeAdjacency(int nodes, const std::vector<std::pair<int, int>>& pairs) {
  const auto counts = [](const std::pair<int, int>& pair) {
    return pair.first >= 0 && pair.second >= 0 && pair.first != pair.second;
  };
  std::vector<int> first(static_cast<std::size_t>(nodes) + 1, 0);
  for (const auto& pair : pairs) {
    assert(pair.first < nodes && pair.second < nodes);
    if (!counts(pair)) continue;
    ++first[static_cast<std::size_t>(pair.first) + 1];
    ++first[static_cast<std::size_t>(pair.second) + 1];
  }
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<int> filled(static_cast<std::size_t>(first.back())), next(first.begin(), first.end() - 1);
  for (const auto& pair : pairs) {
    if (!counts(pair)) continue;
    filled[static_cast<std::size_t>(next[static_cast<std::size_t>(pair.first)]++)] = pair.second;
    filled[static_cast<std::size_t>(next[static_cast<std::size_t>(pair.second)]++)] = pair.first;
  }
  Adjacency made;
  made.first.assign(first.size(), 0);
  made.neighbours.reserve(filled.size());
  for (int i = 0; i < nodes; ++i) {
    const auto begin = filled.begin() + first[static_cast<std::size_t>(i)];
    const auto end = filled.begin() + first[static_cast<std::size_t>(i) + 1];
    std::sort(begin, end);
    made.neighbours.insert(made.neighbours.end(), begin, std::unique(begin, end));
    made.first[static_cast<std::size_t>(i) + 1] = static_cast<int>(made.neighbours.size());
  }
  return made;
}

}  // namespace pose_graph
