// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "linear/symbolic.hpp"

namespace pose_graph {

/// Positions of the blocks of a symmetric matrix, column by column in the elimination order (lower triangle without the
/// diagonal): those of place k are first[k]...first[k + 1] - 1, with ascending rows (places).
struct BlockPattern {
  BlockPattern(const Adjacency& graph, const Symbolic& symbolic);

  /// Position of the block of two nodes, and whether it is stored as (b, a) instead of (a, b); index -1 if they are not
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

/// A symmetric matrix of BxB blocks: the diagonal by places, the other blocks as in BlockPattern.
template <int B>
struct BlockMatrix {
  using Block = Eigen::Matrix<double, B, B>;
  std::vector<Block> diagonal;  ///< both triangles are used
  std::vector<Block> lower;     ///< (row, column)

  void setZero(const BlockPattern& pattern) {
    diagonal.assign(pattern.first.size() - 1, Block::Zero());
    lower.assign(pattern.row.size(), Block::Zero());
  }
};

}  // namespace pose_graph
