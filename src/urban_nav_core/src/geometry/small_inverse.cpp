// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/small_matrices.hpp"

#include <Eigen/LU>

namespace urban_nav_core {

template <int N>
Eigen::Matrix<double, N, N> inverseByLu(const Eigen::Matrix<double, N, N>& A) {
  return A.inverse();
}

template Eigen::Matrix<double, 6, 6> inverseByLu(const Eigen::Matrix<double, 6, 6>&);

}  // namespace urban_nav_core
