// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/dense.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "urban_nav_core/testing/allocations.hpp"

namespace urban_nav_core {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd randomMatrix(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> normal;
  MatrixXd M(rows, columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    for (Eigen::Index r = 0; r < rows; ++r) M(r, c) = normal(random);
  }
  return M;
}

MatrixXd randomPositive(std::mt19937& random, Eigen::Index n) {
  const MatrixXd A = randomMatrix(random, n, n + 3);
  return A * A.transpose() + 0.1 * MatrixXd::Identity(n, n);
}

class DenseOfSize : public ::testing::TestWithParam<int> {
 protected:
  std::mt19937 random_{7};
};

TEST_P(DenseOfSize, CholeskyMultipliesUp) {
  const MatrixXd A = randomPositive(random_, GetParam());
  MatrixXd L = A;
  ASSERT_TRUE(choleskyInPlace(L));
  const MatrixXd lower = L.triangularView<Eigen::Lower>();
  EXPECT_LE((lower * lower.transpose() - A).norm(), 1e-13 * A.norm());
  EXPECT_EQ(MatrixXd(L.triangularView<Eigen::StrictlyUpper>()), MatrixXd(A.triangularView<Eigen::StrictlyUpper>()));
}

TEST_P(DenseOfSize, TriangularSolvesUndoTheirProducts) {
  const Eigen::Index n = GetParam();
  MatrixXd L = randomPositive(random_, n);
  ASSERT_TRUE(choleskyInPlace(L));
  const MatrixXd lower = L.triangularView<Eigen::Lower>();
  const MatrixXd X = randomMatrix(random_, n, 3), Y = randomMatrix(random_, 4, n);
  MatrixXd B = lower * X;
  solveLowerInPlace(L, B);
  EXPECT_LE((B - X).norm(), 1e-10);
  B = lower.transpose() * X;
  solveLowerTransposedInPlace(L, B);
  EXPECT_LE((B - X).norm(), 1e-10);
  B = Y * lower.transpose();
  solveLowerTransposedFromRightInPlace(L, B);
  EXPECT_LE((B - Y).norm(), 1e-10);
}

TEST_P(DenseOfSize, OuterProductTouchesTheLowerTriangleAlone) {
  const Eigen::Index n = GetParam();
  const MatrixXd A = randomMatrix(random_, n, 7), C = randomMatrix(random_, n, n);
  MatrixXd D = C;
  subtractOuterInPlace(D, A);
  const MatrixXd expected = C - A * A.transpose();
  EXPECT_LE((MatrixXd(D.triangularView<Eigen::Lower>()) - MatrixXd(expected.triangularView<Eigen::Lower>())).norm(),
            1e-12);
  EXPECT_EQ(MatrixXd(D.triangularView<Eigen::StrictlyUpper>()), MatrixXd(C.triangularView<Eigen::StrictlyUpper>()));
}

TEST_P(DenseOfSize, SolvesAndInverts) {
  const Eigen::Index n = GetParam();
  const MatrixXd A = randomPositive(random_, n), X = randomMatrix(random_, n, 2);
  MatrixXd work = A, B = A * X;
  ASSERT_TRUE(solvePositiveDefiniteInPlace(work, B));
  EXPECT_LE((B - X).norm(), 1e-9);
  const auto inverse = invertPositiveDefinite(A);
  ASSERT_TRUE(inverse);
  EXPECT_LE((*inverse * A - MatrixXd::Identity(n, n)).norm(), 1e-9);
  EXPECT_EQ(*inverse, MatrixXd(inverse->transpose()));
}

TEST_P(DenseOfSize, InPlaceAllocatesNothing) {
  if (!testing::countsAllocations()) GTEST_SKIP() << "allocations are not counted under a sanitizer";
  const Eigen::Index n = GetParam();
  MatrixXd A = randomPositive(random_, n), B = randomMatrix(random_, n, 5), C = randomPositive(random_, n);
  const MatrixXd D = A;
  const testing::AllocationCount count;
  ASSERT_TRUE(solvePositiveDefiniteInPlace(A, B));
  subtractOuterInPlace(C, B);
  solveLowerTransposedFromRightInPlace(A, C);
  ASSERT_TRUE(choleskyInPlace(Eigen::Map<MatrixXd>(const_cast<double*>(D.data()), n, n)));
  EXPECT_EQ(count.sofar(), 0);
}

INSTANTIATE_TEST_SUITE_P(Sizes, DenseOfSize, ::testing::Values(1, 2, 6, 7, 8, 9, 16, 17, 60, 301));

TEST(Dense, BlocksOfALargerMatrix) {
  std::mt19937 random(3);
  MatrixXd big = randomMatrix(random, 30, 30);
  const MatrixXd before = big, A = randomPositive(random, 11);
  big.block(4, 9, 11, 11) = A;
  ASSERT_TRUE(choleskyInPlace(big.block(4, 9, 11, 11)));
  const MatrixXd L = big.block(4, 9, 11, 11).triangularView<Eigen::Lower>();
  EXPECT_LE((L * L.transpose() - A).norm(), 1e-12 * A.norm());
  EXPECT_EQ(big.topRows(4), before.topRows(4));
  EXPECT_EQ(big.rightCols(10), before.rightCols(10));
}

TEST(Dense, RefusesWhatIsNotPositiveDefinite) {
  MatrixXd A = MatrixXd::Identity(12, 12);
  A(10, 10) = 0.0;
  EXPECT_FALSE(choleskyInPlace(A));
  A = MatrixXd::Identity(12, 12);
  A(10, 10) = -1.0;
  EXPECT_FALSE(invertPositiveDefinite(A));
  A = MatrixXd::Identity(12, 12);
  A(11, 3) = NAN;
  EXPECT_FALSE(choleskyInPlace(A));
  A = MatrixXd::Identity(12, 12);
  A(3, 3) = INFINITY;
  MatrixXd B = MatrixXd::Ones(12, 1);
  EXPECT_FALSE(solvePositiveDefiniteInPlace(A, B));
  EXPECT_EQ(B, MatrixXd::Ones(12, 1));
  EXPECT_FALSE(symmetricEigen(A));
  EXPECT_FALSE(symmetricEigenvalues(A));
  EXPECT_FALSE(pseudoInverse(A, 1e-9));
}

TEST(Dense, SymmetricSolveTakesAnySignature) {
  MatrixXd A(2, 2);
  A << 0.0, 1.0, 1.0, 0.0;
  const auto x = solveSymmetric(A, VectorXd(Eigen::Vector2d(3.0, 5.0)));
  ASSERT_TRUE(x);
  EXPECT_TRUE(x->isApprox(Eigen::Vector2d(5.0, 3.0), 1e-15));
  EXPECT_FALSE(solveSymmetric(MatrixXd::Ones(3, 3), MatrixXd::Ones(3, 1)));
}

TEST(Dense, EigenvaluesAscend) {
  std::mt19937 random(4);
  const MatrixXd A = randomPositive(random, 9);
  const auto eigen = symmetricEigen(A);
  ASSERT_TRUE(eigen);
  EXPECT_LE((A * eigen->vectors - eigen->vectors * eigen->values.asDiagonal()).norm(), 1e-12 * A.norm());
  for (int i = 1; i < 9; ++i) EXPECT_LE(eigen->values[i - 1], eigen->values[i]);
  EXPECT_TRUE(symmetricEigenvalues(A)->isApprox(eigen->values, 1e-12));
}

TEST(Dense, PseudoInverseLeavesEmptyDirectionsEmpty) {
  const VectorXd v = Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0;
  const MatrixXd A = 4.0 * v * v.transpose();
  const auto inverse = pseudoInverse(A, 1e-9);
  ASSERT_TRUE(inverse);
  EXPECT_LE((*inverse - 0.25 * v * v.transpose()).norm(), 1e-15);
  EXPECT_EQ(pseudoInverse(MatrixXd::Zero(3, 3), 1e-9)->norm(), 0.0);
  EXPECT_EQ(pseudoInverse(MatrixXd(0, 0), 1e-9)->size(), 0);
}

}  // namespace
}  // namespace urban_nav_core
