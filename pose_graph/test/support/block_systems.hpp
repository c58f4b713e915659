// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "linear/block_cholesky.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace pose_graph::test {

/// A positive definite matrix on a graph: a squared term for each pair of neighbours and each node. `dense` is in the
/// order of places.
template <int B>
struct BlockSystem {
  Symbolic symbolic;
  BlockPattern pattern;
  BlockMatrix<B> A;
  Eigen::MatrixXd dense;

  BlockSystem(const Adjacency& graph, std::uint64_t seed) : symbolic(analyse(graph)), pattern(graph, symbolic) {
    using Block = Eigen::Matrix<double, B, B>;
    urban_nav_core::testing::Dice dice(seed);
    const auto draw = [&dice] {
      Block M;
      for (int i = 0; i < B * B; ++i) M(i) = dice.normal();
      return M;
    };
    const auto n = static_cast<std::size_t>(graph.size());
    A.setZero(pattern);
    for (std::size_t i = 0; i < n; ++i) {
      const auto place = static_cast<std::size_t>(symbolic.place[i]);
      const Block own = draw();
      A.diagonal[place] += 0.1 * own * own.transpose() + 0.01 * Block::Identity();
      for (int e = graph.first[i]; e < graph.first[i + 1]; ++e) {
        const int j = graph.neighbours[static_cast<std::size_t>(e)];
        if (j < static_cast<int>(i)) continue;
        const Block U = draw(), V = draw();
        A.diagonal[place] += U * U.transpose();
        A.diagonal[static_cast<std::size_t>(symbolic.place[static_cast<std::size_t>(j)])] += V * V.transpose();
        const BlockPattern::Slot slot = pattern.slot(static_cast<int>(i), j);
        Block& block = A.lower[static_cast<std::size_t>(slot.index)];
        if (slot.turned) block += V * U.transpose();
        else block += U * V.transpose();
      }
    }
    makeDense();
  }

  void makeDense() {
    const Eigen::Index n = static_cast<Eigen::Index>(A.diagonal.size());
    dense = Eigen::MatrixXd::Zero(n * B, n * B);
    for (Eigen::Index k = 0; k < n; ++k) {
      dense.block<B, B>(k * B, k * B) = A.diagonal[static_cast<std::size_t>(k)];
      for (int e = pattern.first[static_cast<std::size_t>(k)]; e < pattern.first[static_cast<std::size_t>(k) + 1];
           ++e) {
        const Eigen::Index row = pattern.row[static_cast<std::size_t>(e)];
        dense.block<B, B>(row * B, k * B) = A.lower[static_cast<std::size_t>(e)];
        dense.block<B, B>(k * B, row * B) = A.lower[static_cast<std::size_t>(e)].transpose();
      }
    }
  }
};

}  // namespace pose_graph::test
