// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Eigenvalues>

#include "urban_nav_core/geometry/dense.hpp"

namespace urban_nav_core {

std::optional<SymmetricEigen> symmetricEigen(const ConstMatrixRef& A) {
  if (!A.allFinite()) return std::nullopt;
  if (A.rows() == 0) return SymmetricEigen{};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return SymmetricEigen{solver.eigenvalues(), solver.eigenvectors()};
}

std::optional<Eigen::VectorXd> symmetricEigenvalues(const ConstMatrixRef& A) {
  if (!A.allFinite()) return std::nullopt;
  if (A.rows() == 0) return Eigen::VectorXd{};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, Eigen::EigenvaluesOnly);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return Eigen::VectorXd(solver.eigenvalues());
}

std::optional<Eigen::MatrixXd> pseudoInverse(const ConstMatrixRef& A, double relative_limit) {
  const auto eigen = symmetricEigen(A);
  if (!eigen) return std::nullopt;
  const double limit = eigen->values.size() > 0 ? relative_limit * eigen->values.cwiseAbs().maxCoeff() : 0.0;
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(eigen->values.size());
  for (Eigen::Index i = 0; i < inverse.size(); ++i) {
    if (eigen->values[i] > limit) inverse[i] = 1.0 / eigen->values[i];
  }
  return Eigen::MatrixXd(eigen->vectors * inverse.asDiagonal() * eigen->vectors.transpose());
}

}  // namespace urban_nav_core
