// SPDX-License-Identifier: BSD-3-Clause
#include "manifold/rotation.hpp"

#include <Eigen/SVD>

namespace pose_graph {

Rotation<2> nearestRotation(const Eigen::Matrix2d& M) {
  const double c = M(0, 0) + M(1, 1), s = M(1, 0) - M(0, 1), length = std::hypot(c, s);
  if (!(length > 0.0) || !std::isfinite(length)) return Rotation<2>::Identity();
  Rotation<2> R;
  R << c / length, -s / length, s / length, c / length;
  return R;
}

Rotation<3> nearestRotation(const Eigen::Matrix3d& M) {
  if (!M.allFinite()) return Rotation<3>::Identity();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if (U.determinant() * svd.matrixV().determinant() < 0.0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

}  // namespace pose_graph
