// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/inertial/rotation_preintegration.hpp"

namespace urban_nav_core {

namespace {

Matrix3d rightJacobian(const Vector3d& phi) { return leftJacobianSo3(-phi); }

}  // namespace

void RotationPreintegration::add(const Vector3d& rate, double seconds, double density) {
  const Vector3d turn = (rate - bias_) * seconds;
  const Quaterniond step = expSo3(turn);
  const Matrix3d back = step.conjugate().toRotationMatrix(), J = rightJacobian(turn);
  q_from_to_ = (q_from_to_ * step).normalized();
  J_bias_ = back * J_bias_ - seconds * J;
  covariance_ = back * covariance_ * back.transpose() + density * seconds * J * J.transpose();
  seconds_ += seconds;
}

Quaterniond RotationPreintegration::rotation(const Vector3d& bias) const {
  return (q_from_to_ * expSo3(J_bias_ * (bias - bias_))).normalized();
}

RotationResidual rotationResidual(const RotationPreintegration& measured, const Quaterniond& q_odom_from,
                                  const Quaterniond& q_odom_to, const Vector3d& bias) {
  // A perturbation d of the bias changes the correction xi = J (b - b0) by J_r(xi) J d, a left perturbation of E =
  // Exp(e), which equals the right perturbation -E^T J_r(xi) J d. Perturbations of the poses are right perturbations
  // -R_to^T phi_from and R_to^T phi_to.
  RotationResidual result;
  const Quaterniond E = measured.rotation(bias).conjugate() * q_odom_from.conjugate() * q_odom_to;
  result.e = logSo3(E.normalized());
  const Matrix3d inverse = leftJacobianInverseSo3(-result.e);
  result.to = inverse * q_odom_to.conjugate().toRotationMatrix();
  result.from = -result.to;
  const Vector3d xi = measured.biasJacobian() * (bias - measured.bias());
  result.bias = -inverse * E.conjugate().toRotationMatrix() * rightJacobian(xi) * measured.biasJacobian();
  return result;
}

}  // namespace urban_nav_core
