// SPDX-License-Identifier: BSD-3-Clause
#include "relative_covariance.hpp"

#include <algorithm>

#include "urban_nav_core/geometry/small_matrices.hpp"

namespace laser_mapper {

using urban_nav_core::Matrix6d;
using urban_nav_core::Vector3d;

namespace {

/// Returns the covariance of a frame that is carried along by another one, at `lever` from it.
Matrix6d carried(const Matrix6d& covariance, const Vector3d& lever) {
  Matrix6d jacobian = Matrix6d::Identity();  // rho + phi x lever
  jacobian(0, 4) = lever.z();
  jacobian(0, 5) = -lever.y();
  jacobian(1, 3) = -lever.z();
  jacobian(1, 5) = lever.x();
  jacobian(2, 3) = lever.y();
  jacobian(2, 4) = -lever.x();
  return jacobian * covariance * jacobian.transpose();
}

Matrix6d withPositiveEigenvalues(const Matrix6d& matrix) {
  const Matrix6d symmetric = 0.5 * (matrix + matrix.transpose());
  const auto eigen = urban_nav_core::smallEigen<6>(symmetric);
  return eigen.vectors * eigen.values.cwiseAbs().asDiagonal() * eigen.vectors.transpose();
}

}  // namespace

RelativeCovariances::RelativeCovariances(const urban_nav_core::Trajectory& T_map_base,
                                         const std::vector<Matrix6d>& T_first_base) {
  const std::size_t poses = std::min(T_map_base.size(), T_first_base.size());
  const std::size_t middle = poses / 2;
  for (std::size_t i = 0; i < poses; i += kSpacing) {
    const Vector3d lever = T_map_base[i].pose.t() - T_map_base[middle].pose.t();
    const Matrix6d relative = i >= middle ? Matrix6d(T_first_base[i] - carried(T_first_base[middle], lever))
                                          : carried(T_first_base[middle] - carried(T_first_base[i], -lever), lever);
    covariances_.push_back(withPositiveEigenvalues(relative));
  }
  if (covariances_.empty()) covariances_.push_back(Matrix6d::Zero());
}

const Matrix6d& RelativeCovariances::at(std::size_t pose) const {
  return covariances_[std::min(pose / kSpacing, covariances_.size() - 1)];
}

}  // namespace laser_mapper
