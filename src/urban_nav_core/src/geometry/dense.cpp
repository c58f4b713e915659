// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace urban_nav_core {
namespace {

using Eigen::Index;

// Columns per panel: eight columns of L stay in registers and L1 cache while the rest of a row is streamed.
constexpr Index kPanel = 8;

// Factorises one diagonal block, column by column.
bool factorPanel(MatrixRef D) {
  for (Index j = 0; j < D.cols(); ++j) {
    const Index below = D.rows() - j;
    for (Index k = 0; k < j; ++k) D.col(j).tail(below).noalias() -= D.col(k).tail(below) * D(j, k);
    const double pivot = D(j, j);
    if (!(pivot > 0.0) || !std::isfinite(pivot)) return false;
    const double root = std::sqrt(pivot);
    D.col(j).tail(below) /= root;
    D(j, j) = root;
  }
  return true;
}

}  // namespace

bool choleskyInPlace(MatrixRef A) {
  assert(A.rows() == A.cols());
  const Index n = A.rows();
  for (Index begin = 0; begin < n; begin += kPanel) {
    const Index width = std::min(kPanel, n - begin);
    if (!factorPanel(A.block(begin, begin, n - begin, width))) return false;
    const Index next = begin + width;
    if (next < n) subtractOuterInPlace(A.bottomRightCorner(n - next, n - next), A.block(next, begin, n - next, width));
  }
  return true;
}

// Rank-four updates over columns: unit stride, vectorised, and without the heap-allocated temporary of Eigen's
// products.
void subtractOuterInPlace(MatrixRef C, const ConstMatrixRef& A) {
  assert(C.rows() == C.cols() && A.rows() == C.rows());
  constexpr Index kSteps = 4;
  const Index n = C.rows();
  const Index whole = A.cols() / kSteps * kSteps;
  for (Index j = 0; j < n; ++j) {
    auto column = C.col(j).tail(n - j);
    const auto below = [&A, n, j](Index k) { return A.col(k).tail(n - j); };
    for (Index k = 0; k < whole; k += kSteps) {
      column.noalias() -=
          below(k) * A(j, k) + below(k + 1) * A(j, k + 1) + below(k + 2) * A(j, k + 2) + below(k + 3) * A(j, k + 3);
    }
    for (Index k = whole; k < A.cols(); ++k) column.noalias() -= below(k) * A(j, k);
  }
}

void solveLowerInPlace(const ConstMatrixRef& L, MatrixRef B) {
  const Index n = L.rows();
  for (Index c = 0; c < B.cols(); ++c) {
    for (Index j = 0; j < n; ++j) {
      B(j, c) /= L(j, j);
      const Index below = n - j - 1;
      B.col(c).tail(below).noalias() -= L.col(j).tail(below) * B(j, c);
    }
  }
}

void solveLowerTransposedInPlace(const ConstMatrixRef& L, MatrixRef B) {
  const Index n = L.rows();
  for (Index c = 0; c < B.cols(); ++c) {
    for (Index j = n - 1; j >= 0; --j) {
      const Index below = n - j - 1;
      B(j, c) = (B(j, c) - L.col(j).tail(below).dot(B.col(c).tail(below))) / L(j, j);
    }
  }
}

void solveLowerTransposedFromRightInPlace(const ConstMatrixRef& L, MatrixRef B) {
  assert(B.cols() == L.rows());
  for (Index j = 0; j < L.rows(); ++j) {
    for (Index k = 0; k < j; ++k) B.col(j).noalias() -= B.col(k) * L(j, k);
    B.col(j) /= L(j, j);
  }
}

bool solvePositiveDefiniteInPlace(MatrixRef A, MatrixRef B) {
  if (!choleskyInPlace(A)) return false;
  solveLowerInPlace(A, B);
  solveLowerTransposedInPlace(A, B);
  return true;
}

void mirrorLowerInPlace(MatrixRef A) {
  for (Index j = 0; j < A.cols(); ++j) {
    for (Index i = j + 1; i < A.rows(); ++i) A(j, i) = A(i, j);
  }
}

std::optional<Eigen::MatrixXd> invertPositiveDefinite(const ConstMatrixRef& A) {
  Eigen::MatrixXd L = A;
  if (!choleskyInPlace(L)) return std::nullopt;
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(A.rows(), A.cols());
  solveLowerInPlace(L, inverse);
  solveLowerTransposedInPlace(L, inverse);
  mirrorLowerInPlace(inverse);
  return inverse;
}

std::optional<Eigen::MatrixXd> solveSymmetric(const ConstMatrixRef& A, const ConstMatrixRef& B) {
  if (!A.allFinite() || !B.allFinite()) return std::nullopt;
  // Complete pivoting: LDLT with diagonal pivots fails on indefinite matrices such as [0 1; 1 0].
  const Eigen::MatrixXd full = A.selfadjointView<Eigen::Lower>();
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(full);
  if (!lu.isInvertible()) return std::nullopt;
  return Eigen::MatrixXd(lu.solve(B));
}

}  // namespace urban_nav_core
