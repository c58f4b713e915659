// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "linear/symbolic.hpp"

namespace pose_graph {

/// Where the blocks of a symmetric matrix lie, column by column in the order of elimination (lower triangle without the
/// diagonal): those of place k are first[k]...first[k + 1] - 1, with their rows (places) ascending.
struct BlockPattern {
  BlockPattern(const Adjacency& graph, const Symbolic& symbolic);

  /// The block of two nodes, and whether it stands there as (b, a) instead of (a, b); index -1 where they are no
  /// neighbours.
  struct Slot {
    int index = -1;
    bool turned = false;
  };
  Slot slot(int node_a, int node_b) const;

  const Symbolic* symbolic;
  std::vector<int> first = {0};
  std::vector<int> row;
};

/// A symmetric matrix of BxB blocks with its diagonal by places, and the others where BlockPattern says.
template <int B>
struct BlockMatrix {
  using Block = Eigen::Matrix<double, B, B>;
  std::vector<Block> diagonal;  ///< symmetric; both triangles count
  std::vector<Block> lower;     ///< (row, column)

  void setZero(const BlockPattern& pattern) {
    diagonal.assign(pattern.first.size() - 1, Block::Zero());
    lower.assign(pattern.row.size(), Block::Zero());
  }
};

}  // namespace pose_graph
