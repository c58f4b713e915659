// SPDX-License-Identifier: BSD-3-Clause
#include "window/dense_cholesky.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swf_vo {
namespace {

// A positive definite matrix of the given size with a few digits in every element.
DenseMatrix example(int n) {
  DenseMatrix A;
  A.reset(n);
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i) A(i, j) = i == j ? 2.0 * n : std::sin(1.7 * i + 0.3 * j * j);
  return A;
}

double at(const DenseMatrix& A, int i, int j) { return i >= j ? A(i, j) : A(j, i); }

TEST(DenseCholesky, FactorsAndSolvesAtEverySize) {
  for (const int n : {1, 5, 8, 47, 48, 49, 96, 131}) {
    const DenseMatrix A = example(n);
    DenseMatrix L = A;
    DenseCholesky cholesky;
    cholesky.factor(L, std::vector<double>(static_cast<std::size_t>(n), 1.0));
    EXPECT_EQ(cholesky.heldCount(), 0);
    std::vector<double> x(static_cast<std::size_t>(n)), b(static_cast<std::size_t>(n), 0.0);
    for (int i = 0; i < n; ++i) x[static_cast<std::size_t>(i)] = std::cos(0.9 * i);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) b[static_cast<std::size_t>(i)] += at(A, i, j) * x[static_cast<std::size_t>(j)];
    cholesky.solveLower(b.data());
    cholesky.solveUpper(b.data());
    for (int i = 0; i < n; ++i) EXPECT_NEAR(b[static_cast<std::size_t>(i)], x[static_cast<std::size_t>(i)], 1e-12) << n;
  }
}

TEST(DenseCholesky, GivesTheSameBitsWithEveryInstructionSet) {
  const int n = 131;
  const auto sets = kernels::instructionSets();
  std::vector<DenseMatrix> factors;
  for (const auto& set : sets) {
    factors.push_back(example(n));
    DenseCholesky(set).factor(factors.back(), std::vector<double>(n, 1.0));
    for (int j = 0; j < n; ++j)
      for (int i = j; i < n; ++i) ASSERT_EQ(factors.back()(i, j), factors.front()(i, j)) << set.name;
  }
}

TEST(DenseCholesky, HoldsWhatIsNotDetermined) {
  // Two coordinates of which only the difference is determined: the later one is held, the earlier one is solved for.
  DenseMatrix A;
  A.reset(3);
  A(0, 0) = 4.0;
  A(1, 1) = A(2, 2) = 9.0;
  A(2, 1) = -9.0;
  DenseCholesky cholesky;
  cholesky.factor(A, {1.0, 1.0, 1e-6});
  EXPECT_EQ(cholesky.heldCount(), 1);
  double x[3] = {8.0, 18.0, -18.0};
  cholesky.solveLower(x);
  cholesky.release(x);
  cholesky.solveUpper(x);
  EXPECT_DOUBLE_EQ(x[0], 2.0);
  EXPECT_DOUBLE_EQ(x[1], 2.0);
  EXPECT_DOUBLE_EQ(x[2], 0.0);
}

TEST(StripProduct, SubtractsAProduct) {
  const int n = 21, columns = 7, stride = 24;
  std::vector<double> B(static_cast<std::size_t>(stride * columns));
  for (std::size_t i = 0; i < B.size(); ++i) B[i] = std::sin(0.37 * static_cast<double>(i));
  const DenseMatrix before = example(n);
  DenseMatrix C = before;
  StripProduct().subtract(C, 8, 13, B.data(), columns, stride);
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i) {
      double expected = before(i, j);
      if (j >= 8)
        for (int k = 0; k < columns; ++k)
          expected -= B[static_cast<std::size_t>(k * stride + i - 8)] * B[static_cast<std::size_t>(k * stride + j - 8)];
      EXPECT_NEAR(C(i, j), expected, 1e-13) << i << ' ' << j;
    }
}

}  // namespace
}  // namespace swf_vo
