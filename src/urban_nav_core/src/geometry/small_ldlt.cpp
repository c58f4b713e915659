// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace urban_nav_core {

template <int N, int Columns>
Eigen::Matrix<double, N, Columns> solveByLdlt(const Eigen::Matrix<double, N, N>& A,
                                              const Eigen::Matrix<double, N, Columns>& B) {
  return A.ldlt().solve(B);
}

template Eigen::Matrix<double, 6, 1> solveByLdlt(const Eigen::Matrix<double, 6, 6>&,
                                                 const Eigen::Matrix<double, 6, 1>&);
template Eigen::Matrix<double, 6, 6> solveByLdlt(const Eigen::Matrix<double, 6, 6>&,
                                                 const Eigen::Matrix<double, 6, 6>&);
template Eigen::Matrix<double, 7, 1> solveByLdlt(const Eigen::Matrix<double, 7, 7>&,
                                                 const Eigen::Matrix<double, 7, 1>&);
template Eigen::Matrix<double, 7, 7> solveByLdlt(const Eigen::Matrix<double, 7, 7>&,
                                                 const Eigen::Matrix<double, 7, 7>&);

}  // namespace urban_nav_core
