// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>

namespace urban_nav_core {

// Factorisations of matrices of 3, 6 and 7 rows as plain functions, as dense.hpp has them for any size: a source
// that instantiates one itself takes one to six seconds longer to compile. The bits are those of Eigen's own classes.

/// Cholesky factorisation A = L L^T, of which the lower triangle of A is read. For <2>, <3> and <6>.
template <int N>
class SmallCholesky {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  explicit SmallCholesky(const Matrix& A);

  /// Returns whether A is positive definite to working precision; solutions mean nothing where it is not.
  bool succeeded() const { return llt_.info() == Eigen::Success; }

  /// Returns L in the lower triangle; what is above the diagonal is undefined.
  const Matrix& factor() const { return llt_.matrixLLT(); }

  /// Returns A^-1 b, A^-1 B and A^-1.
  Vector solve(const Vector& b) const;
  Matrix solve(const Matrix& B) const;
  Matrix inverse() const;

  /// Returns L^-1 b: errors of covariance A become errors of unit covariance.
  Vector whiten(const Vector& b) const;

 private:
  Eigen::LLT<Matrix> llt_;
};

/// Returns A^-1 B of a symmetric A by its factorisation L D L^T; NaN or infinities where A is singular. For <6, 1>, <6,
/// 6>, <7, 1>, <7, 7>.
template <int N, int Columns>
Eigen::Matrix<double, N, Columns> solveByLdlt(const Eigen::Matrix<double, N, N>& A,
                                              const Eigen::Matrix<double, N, Columns>& B);

/// Returns the inverse of any matrix, by factors L U with partial pivoting; NaN or infinities where it is singular. For
/// <6>.
template <int N>
Eigen::Matrix<double, N, N> inverseByLu(const Eigen::Matrix<double, N, N>& A);

/// Eigenvalues in ascending order, and unit eigenvectors in columns.
template <int N>
struct SmallEigen {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// Returns the eigen-decomposition of a symmetric matrix, of which the lower triangle is read, by QR iterations. For
/// <3> and <6>.
template <int N>
SmallEigen<N> smallEigen(const Eigen::Matrix<double, N, N>& A);

extern template class SmallCholesky<3>;
extern template class SmallCholesky<6>;

}  // namespace urban_nav_core
