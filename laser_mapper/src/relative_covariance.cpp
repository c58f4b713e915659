// SPDX-License-Identifier: BSD-3-Clause
#include "relative_covariance.hpp"

#include <algorithm>

#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/geometry/so3.hpp"

namespace laser_mapper {

using urban_nav_core::Matrix3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Vector3d;

namespace {

constexpr double kPointDistance = 8.0;  // m, root mean square distance of map points from the robot

/// Returns the covariance of a frame rigidly attached to another one, at `lever` from it.
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

/// Returns the information of a pose, with points around it, on a motion of the whole map about a centre at distance
/// `lever` from the pose.
Matrix6d alignmentWeight(const Vector3d& lever) {
  Matrix6d weight = Matrix6d::Identity();
  const Matrix3d cross = urban_nav_core::skew(lever);
  weight.topRightCorner<3, 3>() = -cross;
  weight.bottomLeftCorner<3, 3>() = cross;
  weight.bottomRightCorner<3, 3>() =
      -cross * cross + 2.0 / 3.0 * kPointDistance * kPointDistance * Matrix3d::Identity();
  return weight;
}

}  // namespace

// Errors of poses are expressed as equivalent motions x_i of the whole map about one centre. Along a chain of
// independent steps they are a random walk: cov(x_i, x_j) = P_min(i,j). The best alignment subtracts their weighted
// mean, sum W_i x_i with sum W_i = I.
RelativeCovariances::RelativeCovariances(const urban_nav_core::Trajectory& T_map_base,
                                         const std::vector<Matrix6d>& T_first_base) {
  const std::size_t poses = std::min(T_map_base.size(), T_first_base.size());
  Vector3d centre = Vector3d::Zero();
  std::size_t used = 0;
  for (std::size_t i = 0; i < poses; i += kSpacing, ++used) centre += T_map_base[i].pose.t();
  centre /= static_cast<double>(std::max<std::size_t>(used, 1));
  std::vector<Vector3d> levers;
  std::vector<Matrix6d> motions, weights;
  Matrix6d sum = Matrix6d::Zero();
  for (std::size_t i = 0; i < poses; i += kSpacing) {
    levers.push_back(T_map_base[i].pose.t() - centre);
    motions.push_back(carried(T_first_base[i], -levers.back()));
    weights.push_back(alignmentWeight(levers.back()));
    sum += weights.back();
  }
  const Matrix6d inverse = used == 0 ? Matrix6d::Zero() : Matrix6d(sum.ldlt().solve(Matrix6d::Identity()));
  Matrix6d after = used == 0 ? Matrix6d::Zero() : Matrix6d(Matrix6d::Identity());  // sum of the weights from pose i on
  Matrix6d mean = Matrix6d::Zero();                                                // covariance of the weighted mean
  for (std::size_t i = 0; i < used; ++i) {
    weights[i] = inverse * weights[i];
    const Matrix6d from = after;
    after -= weights[i];
    mean += weights[i] * motions[i] * from.transpose() + after * motions[i] * weights[i].transpose();
  }
  Matrix6d before = Matrix6d::Zero(), shared = Matrix6d::Zero();  // sums up to pose i of W and of W P
  for (std::size_t i = 0; i < used; ++i) {
    before += weights[i];
    shared += weights[i] * motions[i];
    const Matrix6d with_mean = shared + (Matrix6d::Identity() - before) * motions[i];
    const Matrix6d aligned = motions[i] - with_mean - with_mean.transpose() + mean;
    covariances_.push_back(withPositiveEigenvalues(carried(aligned, levers[i])));
  }
  if (covariances_.empty()) covariances_.push_back(Matrix6d::Zero());
}

const Matrix6d& RelativeCovariances::at(std::size_t pose) const {
  return covariances_[std::min(pose / kSpacing, covariances_.size() - 1)];
}

}  // namespace laser_mapper
