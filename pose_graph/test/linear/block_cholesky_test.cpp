// SPDX-License-Identifier: BSD-3-Clause
#include "linear/block_cholesky.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/block_systems.hpp"
#include "support/patterns.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace pose_graph {
namespace {

using test::BlockSystem;
using urban_nav_core::testing::Dice;

template <int B>
Eigen::MatrixXd assembleFactor(const BlockCholesky<B>& cholesky) {
  const Symbolic& shape = cholesky.symbolic();
  const Eigen::Index n = static_cast<Eigen::Index>(shape.node.size()) * B;
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
  for (int s = 0; s < shape.size(); ++s) {
    const int first = B * shape.begin[static_cast<std::size_t>(s)], pivots = B * shape.columns(s);
    const Eigen::Map<const Eigen::MatrixXd> panel(cholesky.panel(s), cholesky.panelRows(s), pivots);
    for (int j = 0; j < pivots; ++j) {
      for (int i = j; i < pivots; ++i) L(first + i, first + j) = panel(i, j);
      for (int r = 0; r < shape.rowsBelow(s); ++r) {
        const int row = B * shape.rows[static_cast<std::size_t>(shape.row_begin[static_cast<std::size_t>(s)] + r)];
        for (int i = 0; i < B; ++i) L(row + i, first + j) = panel(pivots + r * B + i, j);
      }
    }
  }
  return L;
}

template <int B>
void expectFactorsAndSolves() {
  std::uint64_t seed = 1;
  for (const test::NamedGraph& one : test::manyGraphs()) {
    SCOPED_TRACE(one.name + " in blocks of " + std::to_string(B));
    const BlockSystem<B> system(one.graph, ++seed);
    BlockCholesky<B> cholesky(system.symbolic);
    ASSERT_TRUE(cholesky.factor(system.A, system.pattern));
    const Eigen::MatrixXd L = assembleFactor(cholesky);
    EXPECT_LT((L * L.transpose() - system.dense).norm(), 1e-12 * (1.0 + system.dense.norm()));

    const Eigen::Index n = system.dense.rows();
    Dice dice(seed);
    Eigen::MatrixXd x(n, 3);
    for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = dice.normal();
    const Eigen::MatrixXd b = system.dense * x;
    Eigen::MatrixXd solved = b, first = b.col(0);
    cholesky.solve(solved.data(), 3);
    cholesky.solve(first.data());
    EXPECT_LT((system.dense * solved - b).norm(), 1e-9 * (1.0 + b.norm()));
    EXPECT_EQ((solved.leftCols(1) - first).norm(), 0.0);

    Eigen::Matrix<double, Eigen::Dynamic, 8, Eigen::RowMajor> eight(n, 8);
    for (Eigen::Index i = 0; i < eight.size(); ++i) eight.data()[i] = dice.normal();
    const Eigen::MatrixXd right = system.dense * eight;
    auto sides = eight;
    sides = right;
    cholesky.solveEight(sides.data());
    EXPECT_LT((system.dense * sides - right).norm(), 1e-9 * (1.0 + right.norm()));
  }
}
TEST(BlockCholesky, EqualsTheDenseFactor) {
  expectFactorsAndSolves<2>();
  expectFactorsAndSolves<3>();
  expectFactorsAndSolves<6>();
}

TEST(BlockCholesky, LargeFrontsToo) {
  const BlockSystem<6> system(test::cubeGraph(8), 5);
  BlockCholesky<6> cholesky(system.symbolic);
  ASSERT_TRUE(cholesky.factor(system.A, system.pattern));
  Eigen::VectorXd x = Eigen::VectorXd::Ones(system.dense.rows());
  const Eigen::VectorXd b = system.dense * x;
  x = b;
  cholesky.solve(x.data());
  EXPECT_LT((system.dense * x - b).norm(), 1e-10 * b.norm());
}

TEST(BlockCholesky, MayBeFactoredAgainAfterARefusal) {
  BlockSystem<3> system(test::chainWithClosures(50, 30, 3), 4);
  BlockCholesky<3> cholesky(system.symbolic), fresh(system.symbolic);
  const auto good = system.A;
  system.A.diagonal[25](1, 1) = -1.0;
  EXPECT_FALSE(cholesky.factor(system.A, system.pattern));
  ASSERT_TRUE(cholesky.factor(good, system.pattern));
  ASSERT_TRUE(fresh.factor(good, system.pattern));
  EXPECT_EQ((assembleFactor(cholesky) - assembleFactor(fresh)).norm(), 0.0);
}

TEST(BlockCholesky, RefusesWhatIsNotPositiveDefinite) {
  for (const std::size_t place : {0U, 17U, 49U}) {
    for (const double value : {0.0, -1e-3, std::numeric_limits<double>::quiet_NaN(),
                               -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}) {
      BlockSystem<3> system(test::chainWithClosures(50, 30, 3), 4);
      system.A.diagonal[place](2, 2) = value;
      EXPECT_FALSE(BlockCholesky<3>(system.symbolic).factor(system.A, system.pattern)) << place << " " << value;
    }
  }
  BlockSystem<3> system(test::chainWithClosures(50, 30, 3), 4);
  system.A.lower[20](1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(BlockCholesky<3>(system.symbolic).factor(system.A, system.pattern));
}

TEST(BlockCholesky, AnyBlockOfTheInverse) {
  for (const test::NamedGraph& one : test::manyGraphs()) {
    if (one.graph.size() == 0) continue;
    const BlockSystem<3> system(one.graph, 5);
    BlockCholesky<3> cholesky(system.symbolic);
    ASSERT_TRUE(cholesky.factor(system.A, system.pattern));
    const auto inverse = urban_nav_core::invertPositiveDefinite(system.dense);
    ASSERT_TRUE(inverse);
    for (int row = 0; row < one.graph.size(); row += 3)
      for (int column = 0; column < one.graph.size(); column += 2)
        EXPECT_LT((cholesky.inverseBlock(row, column) - inverse->block<3, 3>(3 * row, 3 * column)).norm(),
                  1e-9 * inverse->norm())
            << one.name;
  }
}

/// Parts without absolute position: as many pins as free directions, and a factor of the matrix plus pins.
TEST(BlockCholesky, PinsWhatIsFree) {
  const Adjacency graph = test::chainWithClosures(40, 10, 2);
  BlockSystem<3> system(graph, 3);
  system.A.setZero(system.pattern);
  for (int a = 0; a < graph.size(); ++a)
    for (int e = graph.first[static_cast<std::size_t>(a)]; e < graph.first[static_cast<std::size_t>(a) + 1]; ++e) {
      const int b = graph.neighbours[static_cast<std::size_t>(e)];
      const bool bridge = (a < 20) != (b < 20);
      // The second coordinate has two separate parts.
      const Eigen::Vector3d weight(1.0 + a + b, bridge ? 0.0 : 2.0, 3.0);
      system.A.diagonal[static_cast<std::size_t>(system.symbolic.place[static_cast<std::size_t>(a)])] +=
          weight.asDiagonal();
      if (a < b) system.A.lower[static_cast<std::size_t>(system.pattern.slot(a, b).index)] -= weight.asDiagonal();
    }
  BlockCholesky<3> cholesky(system.symbolic);
  std::vector<int> pinned;
  ASSERT_TRUE(cholesky.factorPinned(system.A, system.pattern, pinned));
  ASSERT_EQ(pinned.size(), 4U);
  int coordinates[3] = {0, 0, 0};
  for (const int entry : pinned) {
    ++coordinates[entry % 3];
    system.A.diagonal[static_cast<std::size_t>(entry / 3)](entry % 3, entry % 3) +=
        BlockCholesky<3>::computePin(system.A, entry);
  }
  EXPECT_EQ(coordinates[1], 2);
  system.makeDense();
  const Eigen::MatrixXd L = assembleFactor(cholesky);
  EXPECT_LT((L * L.transpose() - system.dense).norm(), 1e-12 * system.dense.norm());
}

TEST(BlockCholesky, PinsNothingOfADefiniteMatrix) {
  const BlockSystem<6> system(test::chainWithClosures(60, 40, 3), 4);
  BlockCholesky<6> pins(system.symbolic), plain(system.symbolic);
  std::vector<int> pinned = {1};
  ASSERT_TRUE(pins.factorPinned(system.A, system.pattern, pinned));
  ASSERT_TRUE(plain.factor(system.A, system.pattern));
  EXPECT_TRUE(pinned.empty());
  EXPECT_EQ((assembleFactor(pins) - assembleFactor(plain)).norm(), 0.0);
}

}  // namespace
}  // namespace pose_graph
