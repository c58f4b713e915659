// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/compose.hpp"

namespace urban_nav_core {
namespace {

Matrix6d blocks(const Matrix3d& tt, const Matrix3d& tr, const Matrix3d& rr) {
  Matrix6d M;
  M << tt, tr, Matrix3d::Zero(), rr;
  return M;
}

// Keeps covariances symmetric despite rounding: thousands of products are computed along a trajectory.
Matrix6d moved(const Matrix6d& J, const Matrix6d& covariance) {
  const Matrix6d M = J * covariance * J.transpose();
  return 0.5 * (M + M.transpose());
}

}  // namespace

Composition compose(const Pose& T_a_b, const Pose& T_b_c) {
  const Matrix3d R_a_b = T_a_b.R();
  return {T_a_b * T_b_c, blocks(Matrix3d::Identity(), -skew(R_a_b * T_b_c.t()), Matrix3d::Identity()),
          blocks(R_a_b, Matrix3d::Zero(), R_a_b)};
}

Inversion invert(const Pose& T_a_b) {
  const Matrix3d R_b_a = T_a_b.q().conjugate().toRotationMatrix();
  return {T_a_b.inverse(), blocks(-R_b_a, -R_b_a * skew(T_a_b.t()), -R_b_a)};
}

Between between(const Pose& T_a_b, const Pose& T_a_c) {
  const Matrix3d R_b_a = T_a_b.q().conjugate().toRotationMatrix();
  return {T_a_b.inverse() * T_a_c, blocks(-R_b_a, R_b_a * skew(T_a_c.t() - T_a_b.t()), -R_b_a),
          blocks(R_b_a, Matrix3d::Zero(), R_b_a)};
}

PoseWithCovariance compose(const PoseWithCovariance& T_a_b, const PoseWithCovariance& T_b_c) {
  const Composition c = compose(T_a_b.pose, T_b_c.pose);
  return {c.T_a_c, moved(c.J1, T_a_b.covariance) + moved(c.J2, T_b_c.covariance)};
}

PoseWithCovariance invert(const PoseWithCovariance& T_a_b) {
  const Inversion inversion = invert(T_a_b.pose);
  return {inversion.T_b_a, moved(inversion.J, T_a_b.covariance)};
}

}  // namespace urban_nav_core
