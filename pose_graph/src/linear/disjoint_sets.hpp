// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linear/index.hpp"

namespace pose_graph {

/// Returns the root of the set that holds `i` (Tarjan 1975, path halving). `above[i]` is the parent of i, a root is its
/// own parent; parents on the path are shortened. Two elements are in one set where their roots are equal.
inline int findRoot(std::vector<int>& above, int i) {
  while (above[sz(i)] != i) i = above[sz(i)] = above[sz(above[sz(i)])];
  return i;
}

}  // namespace pose_graph
