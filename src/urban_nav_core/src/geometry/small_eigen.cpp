// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/small_matrices.hpp"

#include <Eigen/Eigenvalues>

namespace urban_nav_core {

template <int N>
SmallEigen<N> smallEigen(const Eigen::Matrix<double, N, N>& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template SmallEigen<3> smallEigen(const Eigen::Matrix<double, 3, 3>&);
template SmallEigen<6> smallEigen(const Eigen::Matrix<double, 6, 6>&);

}  // namespace urban_nav_core
