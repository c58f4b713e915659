// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linear/pattern.hpp"

namespace pose_graph {

/// Structure of the Cholesky factor of a symmetric block matrix as supernodes: consecutive columns with (almost) the
/// same rows, factored as one dense panel. Computed once per graph; valid for all block sizes.
///
/// A place is the position of a node in the elimination order. Supernode s contains the places begin[s]...begin[s + 1]
/// - 1; the rows below it are the places rows[row_begin[s]]...rows[row_begin[s + 1] - 1], ascending. Supernodes are in
/// postorder: children precede their parent, and a subtree directly precedes its root.
struct Symbolic {
  std::vector<int> place;  ///< of each node
  std::vector<int> node;   ///< at each place
  std::vector<int> begin = {0};
  std::vector<int> row_begin = {0};
  std::vector<int> rows;
  std::vector<int> parent;     ///< of each supernode, -1 for a root
  std::vector<int> supernode;  ///< of each place
  double work = 0.0;           ///< factorWork() (ordering.hpp)

  int size() const { return static_cast<int>(begin.size()) - 1; }
  int columns(int s) const { return begin[static_cast<std::size_t>(s) + 1] - begin[static_cast<std::size_t>(s)]; }
  int rowsBelow(int s) const {
    return row_begin[static_cast<std::size_t>(s) + 1] - row_begin[static_cast<std::size_t>(s)];
  }
};

/// Orders the nodes (ordering.hpp) and finds the supernodes. Small ones are merged into their parents if that adds few
/// zeros.
Symbolic analyse(const Adjacency& graph);
Symbolic analyse(const Adjacency& graph, const std::vector<int>& order);

}  // namespace pose_graph
