// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/LU>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace pose_graph {

using urban_nav_core::Matrix6d;

namespace {

// Rotates both blocks of (rho, phi) from the parent's axes to those of the child, which are the error's axes.
Matrix6d seenFromChild(const Matrix6d& matrix, const Pose& T_parent_child) {
  const Eigen::Matrix3d R = T_parent_child.R();
  Matrix6d turned;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) turned.block<3, 3>(3 * i, 3 * j) = R.transpose() * matrix.block<3, 3>(3 * i, 3 * j) * R;
  return 0.5 * (turned + turned.transpose());
}

}  // namespace

TangentMatrix<3> chainInformation(const urban_nav_core::RelativePose& step) {
  const bool has_drift = step.drift_covariance.trace() > 0.0;
  const Matrix6d covariance = seenFromChild(has_drift ? step.drift_covariance : step.covariance, step.T_from_to);
  const Matrix6d information = urban_nav_core::SmallCholesky<6>(covariance).inverse();
  return 0.5 * (information + information.transpose());
}

// The error of b is rotated from its own axes to those of a; a rotation error of a displaces b by its lever arm.
Matrix6d relativeNoise(const Pose& T_a_b, const Matrix6d& noise_a, const Matrix6d& noise_b) {
  Matrix6d at_b = Matrix6d::Zero(), at_a = Matrix6d::Identity();
  at_b.topLeftCorner<3, 3>() = at_b.bottomRightCorner<3, 3>() = T_a_b.R();
  at_a.topRightCorner<3, 3>() = -urban_nav_core::skew(T_a_b.t());
  return at_a * noise_a * at_a.transpose() + at_b * noise_b * at_b.transpose();
}

// (W^-1 + N)^-1 = W - W (W + N^-1)^-1 W needs no inverse of W: its free directions remain free.
TangentMatrix<3> closureInformation(const urban_nav_core::Constraint& measured, const Matrix6d& noise_a,
                                    const Matrix6d& noise_b) {
  const Matrix6d W = 0.5 * (measured.information + measured.information.transpose());
  const Matrix6d N = relativeNoise(measured.T_a_b, noise_a, noise_b);
  const urban_nav_core::SmallCholesky<6> noise(N);
  if (!(N.trace() > 0.0) || !noise.succeeded()) return seenFromChild(W, measured.T_a_b);
  const Matrix6d together = W + noise.inverse();
  return seenFromChild(W - W * urban_nav_core::SmallCholesky<6>(0.5 * (together + together.transpose())).solve(W),
                       measured.T_a_b);
}

}  // namespace pose_graph
