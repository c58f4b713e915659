// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/small_matrices.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {
namespace {

template <int N>
Eigen::Matrix<double, N, N> wavyMatrix() {
  Eigen::Matrix<double, N, N> A;
  for (int i = 0; i < N * N; ++i) A(i / N, i % N) = std::sin(1.0 + 1.7 * i * i);
  return A;
}

template <int N>
Eigen::Matrix<double, N, N> positiveMatrix() {
  const Eigen::Matrix<double, N, N> A = wavyMatrix<N>();
  return A * A.transpose() + 0.1 * Eigen::Matrix<double, N, N>::Identity();
}

template <int N>
void expectCholesky() {
  const Eigen::Matrix<double, N, N> A = positiveMatrix<N>(), B = wavyMatrix<N>(), one = B.Identity();
  const Eigen::Matrix<double, N, 1> b = B.col(1);
  const SmallCholesky<N> factored(A);
  ASSERT_TRUE(factored.succeeded());
  const Eigen::Matrix<double, N, N> L = factored.factor().template triangularView<Eigen::Lower>();
  EXPECT_LT((L * L.transpose() - A).norm(), 1e-12);
  EXPECT_LT((A * factored.solve(b) - b).norm(), 1e-11);
  EXPECT_LT((A * factored.solve(B) - B).norm(), 1e-11);
  EXPECT_LT((A * factored.inverse() - one).norm(), 1e-11);
  EXPECT_NEAR(factored.whiten(b).squaredNorm(), b.dot(factored.solve(b)), 1e-10);
  EXPECT_FALSE(SmallCholesky<N>(A - 2.0 * A.trace() * one).succeeded());
}

TEST(SmallMatrices, CholeskyFactorMultipliesBack) {
  expectCholesky<3>();
  expectCholesky<6>();
}

TEST(SmallMatrices, SolutionsOfSymmetricMatricesMultiplyBack) {
  // Indefinite.
  const Matrix6d B = wavyMatrix<6>(), A = B + B.transpose();
  const Vector6d b = B.col(2);
  EXPECT_LT((A * solveByLdlt<6, 1>(A, b) - b).norm(), 1e-10);
  EXPECT_LT((A * solveByLdlt<6, 6>(A, B) - B).norm(), 1e-10);
  const Eigen::Matrix<double, 7, 7> C = positiveMatrix<7>();
  EXPECT_LT((C * solveByLdlt<7, 7>(C, C.Identity()) - C.Identity()).norm(), 1e-10);
}

TEST(SmallMatrices, InverseMultipliesBack) {
  const Matrix6d A = wavyMatrix<6>() + 0.5 * Matrix6d::Identity();
  EXPECT_LT((A * inverseByLu<6>(A) - Matrix6d::Identity()).norm(), 1e-9);
  EXPECT_FALSE(inverseByLu<6>(Matrix6d::Zero()).allFinite());
}

template <int N>
void expectEigen() {
  const Eigen::Matrix<double, N, N> A = wavyMatrix<N>() + wavyMatrix<N>().transpose(), one = A.Identity();
  const SmallEigen<N> eigen = smallEigen<N>(A);
  EXPECT_LT((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - A).norm(), 1e-12);
  EXPECT_LT((eigen.vectors.transpose() * eigen.vectors - one).norm(), 1e-12);
  for (int i = 1; i < N; ++i) EXPECT_LE(eigen.values[i - 1], eigen.values[i]);
}

TEST(SmallMatrices, EigenvectorsAreOrthogonalAndMultiplyBack) {
  expectEigen<3>();
  expectEigen<6>();
}

}  // namespace
}  // namespace urban_nav_core
