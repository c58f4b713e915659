// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace urban_nav_core {

template <int N>
SmallCholesky<N>::SmallCholesky(const Matrix& A) : llt_(A) {}

template <int N>
auto SmallCholesky<N>::solve(const Vector& b) const -> Vector {
  return llt_.solve(b);
}

template <int N>
auto SmallCholesky<N>::solve(const Matrix& B) const -> Matrix {
  return llt_.solve(B);
}

template <int N>
auto SmallCholesky<N>::inverse() const -> Matrix {
  return llt_.solve(Matrix::Identity());
}

template <int N>
auto SmallCholesky<N>::whiten(const Vector& b) const -> Vector {
  return llt_.matrixL().solve(b);
}

template class SmallCholesky<2>;
template class SmallCholesky<3>;
template class SmallCholesky<6>;

}  // namespace urban_nav_core
