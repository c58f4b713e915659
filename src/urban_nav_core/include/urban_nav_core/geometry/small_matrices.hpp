// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>

namespace urban_nav_core {

// Factorisations of matrices with 3, 6 and 7 rows as plain functions (dense.hpp: of any size). A source that
// instantiates one of Eigen's takes one to six seconds longer to compile. Results are bit-identical to those of Eigen's
// classes.

/// Cholesky factorisation A = L L^T; the lower triangle of A is read. For <2>, <3> and <6>.
template <int N>
class SmallCholesky {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  explicit SmallCholesky(const Matrix& A);

  /// Returns whether A is positive definite to working precision; if not, solutions are invalid.
  bool succeeded() const { return llt_.info() == Eigen::Success; }

  /// Returns L in the lower triangle; the strictly upper triangle is undefined.
  const Matrix& factor() const { return llt_.matrixLLT(); }

  /// Returns A^-1 b, A^-1 B and A^-1.
  Vector solve(const Vector& b) const;
  Matrix solve(const Matrix& B) const;
  Matrix inverse() const;

  /// Returns L^-1 b: transforms errors of covariance A to unit covariance.
  Vector whiten(const Vector& b) const;

 private:
  Eigen::LLT<Matrix> llt_;
};

/// Returns A^-1 B for a symmetric A, by L D L^T; NaN or infinities if A is singular. For <6, 1>, <6, 6>, <7, 1>, <7,
/// 7>.
template <int N, int Columns>
Eigen::Matrix<double, N, Columns> solveByLdlt(const Eigen::Matrix<double, N, N>& A,
                                              const Eigen::Matrix<double, N, Columns>& B);

/// Returns the inverse of any matrix, by LU with partial pivoting; NaN or infinities if it is singular. For <6>.
template <int N>
Eigen::Matrix<double, N, N> inverseByLu(const Eigen::Matrix<double, N, N>& A);

/// Eigenvalues in ascending order, and unit eigenvectors in columns.
template <int N>
struct SmallEigen {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// Returns the eigen-decomposition of a symmetric matrix by QR iterations; the lower triangle is read. For <3> and <6>.
template <int N>
SmallEigen<N> smallEigen(const Eigen::Matrix<double, N, N>& A);

extern template class SmallCholesky<3>;
extern template class SmallCholesky<6>;

}  // namespace urban_nav_core
