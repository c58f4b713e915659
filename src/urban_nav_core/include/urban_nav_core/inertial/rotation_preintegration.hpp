// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/so3.hpp"

namespace urban_nav_core {

/// Preintegrated rotation of a body from gyroscope rates, on the manifold (Forster et al. 2017, eq. 33, 35, 44 and
/// A.7): R_from_to, its covariance and its Jacobian with respect to the bias, which makes a second integration
/// unnecessary when the bias changes. Tangents as in so3.hpp.
class RotationPreintegration {
 public:
  /// `bias`: subtracted from the rates, rad/s.
  explicit RotationPreintegration(const Vector3d& bias = Vector3d::Zero()) : bias_(bias) {}

  /// Integrates a rate (rad/s) over `seconds` (0 or more). The integral has the variance `density` (rad^2/s) times
  /// `seconds` about each axis. Requires finite arguments.
  void add(const Vector3d& rate, double seconds, double density);

  /// Returns R_from_to at the bias that was subtracted.
  const Quaterniond& rotation() const { return q_from_to_; }
  /// Returns R_from_to at another bias, to first order in the difference: rotation() Exp(J (bias - that subtracted)).
  Quaterniond rotation(const Vector3d& bias) const;
  /// Returns J, seconds: right perturbation of the rotation for a change of the bias.
  const Matrix3d& biasJacobian() const { return J_bias_; }
  /// Returns the covariance of the right perturbation d, R_true = R Exp(d), from the noise of the rates only, rad^2.
  const Matrix3d& covariance() const { return covariance_; }
  /// Returns the bias that was subtracted, rad/s.
  const Vector3d& bias() const { return bias_; }
  double seconds() const { return seconds_; }

 private:
  Vector3d bias_;
  Quaterniond q_from_to_ = Quaterniond::Identity();
  Matrix3d J_bias_ = Matrix3d::Zero();
  Matrix3d covariance_ = Matrix3d::Zero();
  double seconds_ = 0.0;
};

/// e = Log(R(bias)^-1 R_odom_from^-1 R_odom_to), zero where rates and rotations agree, with exact Jacobians with
/// respect to left perturbations Exp(phi) R of both rotations (boxPlus) and to the bias.
struct RotationResidual {
  Vector3d e;
  Matrix3d from, to, bias;
};
RotationResidual rotationResidual(const RotationPreintegration& measured, const Quaterniond& q_odom_from,
                                  const Quaterniond& q_odom_to, const Vector3d& bias);

}  // namespace urban_nav_core
