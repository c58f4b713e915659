// SPDX-License-Identifier: BSD-3-Clause
#include "window/process_model.hpp"

namespace swf_vo::process_model {

using urban_nav_core::boxMinus;
using urban_nav_core::leftJacobianInverseSo3;
using urban_nav_core::Matrix3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::skew;
using urban_nav_core::Vector6d;

Matrix6d floor() {
  Vector6d diagonal;
  diagonal << 1e-6, 1e-6, 1e-6, 0.1, 0.1, 0.1;
  return diagonal.asDiagonal();
}

Pose predict(const Pose& T_odom_last, const ProcessInput& u) { return T_odom_last * u.T_from_to; }

Pose makeStart(const Pose& T_odom_last, const ProcessInput& u) {
  return u.T_from_start ? T_odom_last * *u.T_from_start : predict(T_odom_last, u);
}

Vector6d error(const Pose& T_odom_last, const Pose& T_odom_next, const Pose& u) {
  return boxMinus(T_odom_last.inverse() * T_odom_next, u);
}

Residual residual(const Pose& T_odom_last, const Pose& T_odom_next, const Pose& u) {
  // With T_last -> (t + rho, Exp(phi) R): the relative translation R^T (t' - t) changes by -R^T rho + R^T [t' - t]x
  // phi, and the relative rotation is multiplied by Exp(-R^T phi) from the left; for the next pose with opposite signs.
  Residual result;
  result.e = error(T_odom_last, T_odom_next, u);
  const Matrix3d Rt = T_odom_last.R().transpose();
  const Matrix3d rotation = leftJacobianInverseSo3(result.e.tail<3>()) * Rt;
  result.last.setZero();
  result.next.setZero();
  result.last.topLeftCorner<3, 3>() = -Rt;
  result.last.topRightCorner<3, 3>() = Rt * skew(T_odom_next.t() - T_odom_last.t());
  result.last.bottomRightCorner<3, 3>() = -rotation;
  result.next.topLeftCorner<3, 3>() = Rt;
  result.next.bottomRightCorner<3, 3>() = rotation;
  return result;
}

}  // namespace swf_vo::process_model
