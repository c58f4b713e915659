// SPDX-License-Identifier: BSD-3-Clause
#include "window/covariance.hpp"

#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/geometry/dense_kernels.hpp"

namespace swf_vo::covariance {

namespace kernels = urban_nav_core::kernels;

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

namespace {

template <typename Matrix>
Matrix symmetric(const Matrix& M) {
  return 0.5 * (M + M.transpose());
}

}  // namespace

namespace {

// Derivative of the estimates by the disparity offset.
template <int N>
Eigen::Matrix<double, N, 1> perOffset(const Solver& solver, std::size_t row) {
  Eigen::Matrix<double, N, 1> s;
  for (int i = 0; i < N; ++i) s[i] = solver.perOffset(row + static_cast<std::size_t>(i));
  return s;
}

}  // namespace

Matrix6d marginal(const Solver& solver, std::size_t j, double offset_variance) {
  const Vector6d s = perOffset<6>(solver, solver.toRow(j));
  return givenOffset(solver, j) + offset_variance * s * s.transpose();
}

Matrix6d givenOffset(const Solver& solver, std::size_t j) {
  Matrix6d P;
  for (int c = 0; c < 6; ++c)
    P.col(c) = Eigen::Map<const urban_nav_core::Vector6d>(solver.inverseColumn(j, c, true).data() + solver.toRow(j));
  return symmetric(P);
}

Matrix12d joint(const Solver& solver, std::size_t j, double offset_variance) {
  Matrix12d P;
  for (int c = 0; c < 12; ++c) {
    const auto& column = solver.inverseColumn(j + static_cast<std::size_t>(c / 6), c % 6, true);
    P.col(c) = Eigen::Map<const Eigen::Matrix<double, 12, 1>>(column.data() + solver.toRow(j));
  }
  const Eigen::Matrix<double, 12, 1> s = perOffset<12>(solver, solver.toRow(j));
  return symmetric(Matrix12d(P + offset_variance * s * s.transpose()));
}

Matrix12d leftAndOldest(const Solver& solver, const Matrix6d& left, const Departed& departed, double offset_variance) {
  const Eigen::Index size = static_cast<Eigen::Index>(departed.gain.size() / 6);
  const Eigen::Map<const Eigen::MatrixXd> G(departed.gain.data(), size, 6);
  Matrix12d P;
  P.topLeftCorner<6, 6>() = left;
  const std::vector<double>& columns = solver.inverseColumns(0);
  const Eigen::Map<const Eigen::MatrixXd> X(columns.data(), static_cast<Eigen::Index>(columns.size() / 6), 6);
  for (int c = 0; c < 6; ++c)
    for (int r = 0; r < 6; ++r) P(r, 6 + c) = kernels::dot(G.col(r).data(), X.col(c).data(), static_cast<int>(size));
  P.block<6, 6>(6, 6) = X.block<6, 6>(static_cast<Eigen::Index>(solver.toRow(0)), 0);
  P.bottomLeftCorner<6, 6>() = P.topRightCorner<6, 6>().transpose();
  Eigen::Matrix<double, 12, 1> s;
  s.tail<6>() = perOffset<6>(solver, solver.toRow(0));
  s.head<6>() = departed.offset_gain;
  for (Eigen::Index i = 0; i < size; ++i)
    s.head<6>() += G.row(i).transpose() * solver.perOffset(static_cast<std::size_t>(i));
  P += offset_variance * s * s.transpose();
  return symmetric(P);
}

Matrix6d relative(const Pose& T_odom_a, const Pose& T_odom_b, const Matrix12d& joint) {
  const urban_nav_core::Between between = urban_nav_core::between(T_odom_a, T_odom_b);
  Eigen::Matrix<double, 6, 12> J;
  J << between.J1, between.J2;
  return symmetric(Matrix6d(J * joint * J.transpose()));
}

Matrix6d propagate(const Pose& T_odom_last, const Matrix6d& covariance, const ProcessInput& u) {
  const urban_nav_core::Composition composed = urban_nav_core::compose(T_odom_last, u.T_from_to);
  Matrix6d information = u.information + process_model::floor(), Q = Matrix6d::Identity();
  urban_nav_core::solvePositiveDefiniteInPlace(information, Q);
  return symmetric(
      Matrix6d(composed.J1 * covariance * composed.J1.transpose() + composed.J2 * Q * composed.J2.transpose()));
}

}  // namespace swf_vo::covariance
