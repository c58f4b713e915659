// SPDX-License-Identifier: BSD-3-Clause
#include "marginals/selected_inverse.hpp"

#include <gtest/gtest.h>

#include "support/block_systems.hpp"
#include "support/patterns.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace pose_graph::test {
namespace {

template <int B>
void expectDense(const Adjacency& graph, std::uint64_t seed) {
  const BlockSystem<B> system(graph, seed);
  BlockCholesky<B> cholesky(system.symbolic);
  ASSERT_TRUE(cholesky.factor(system.A, system.pattern));
  const BlockMatrix<B> selected = selectedInverse(cholesky, system.pattern);
  if (graph.size() == 0) return;
  const auto inverse = urban_nav_core::invertPositiveDefinite(system.dense);
  ASSERT_TRUE(inverse);
  const Eigen::MatrixXd& dense = *inverse;
  const double tolerance = 1e-9 * dense.norm();
  for (std::size_t k = 0; k + 1 < system.pattern.first.size(); ++k) {
    const Eigen::Index column = B * static_cast<Eigen::Index>(k);
    EXPECT_LT((selected.diagonal[k] - dense.block<B, B>(column, column)).norm(), tolerance);
    EXPECT_EQ((selected.diagonal[k] - selected.diagonal[k].transpose()).norm(), 0.0);
    for (int e = system.pattern.first[k]; e < system.pattern.first[k + 1]; ++e) {
      const Eigen::Index row = B * system.pattern.row[static_cast<std::size_t>(e)];
      EXPECT_LT((selected.lower[static_cast<std::size_t>(e)] - dense.block<B, B>(row, column)).norm(), tolerance);
    }
  }
}

TEST(SelectedInverse, EqualsTheDenseInverse) {
  std::uint64_t seed = 1;
  for (const NamedGraph& one : manyGraphs()) {
    SCOPED_TRACE(one.name);
    expectDense<2>(one.graph, ++seed);
    expectDense<3>(one.graph, seed);
    expectDense<6>(one.graph, seed);
  }
}

TEST(SelectedInverse, LargeFrontsToo) { expectDense<3>(cubeGraph(7), 5); }

}  // namespace
}  // namespace pose_graph::test
