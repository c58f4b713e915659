// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "linear/index.hpp"

namespace pose_graph {

/// Disjoint sets of 0 ... n-1, initially singletons (Tarjan 1975, path halving). The root of a set is its smallest
/// element.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : above_(size) { std::iota(above_.begin(), above_.end(), 0); }

  int size() const { return static_cast<int>(above_.size()); }

  int root(int i) {
    while (above_[sz(i)] != i) i = above_[sz(i)] = above_[sz(above_[sz(i)])];
    return i;
  }

  bool areJoined(int a, int b) { return root(a) == root(b); }

  /// Joins the sets of two elements. Returns false if they were in one set already.
  bool join(int a, int b) {
    const auto [first, second] = std::minmax({root(a), root(b)});
    above_[sz(second)] = first;
    return first != second;
  }

  /// Joins the sets of all these elements.
  void joinAll(const std::vector<int>& members) {
    for (const int member : members) join(members.front(), member);
  }

 private:
  std::vector<int> above_;  // a root points to itself
};

}  // namespace pose_graph
