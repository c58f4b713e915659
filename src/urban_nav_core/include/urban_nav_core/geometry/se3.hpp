// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "urban_nav_core/geometry/so3.hpp"

namespace urban_nav_core {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Rigid transform T_a_b: p_a = R p_b + t, and T_a_b * T_b_c = T_a_c. The rotation is a unit quaternion; products are
/// normalised, so that errors do not accumulate. A quaternion that is of unit length to the last bits is not
/// normalised, so that poses read from a file are written unchanged.
class Pose {
 public:
  Pose() : q_(Quaterniond::Identity()), t_(Vector3d::Zero()) {}
  /// Normalises q. Asserts that q is finite and not zero.
  Pose(const Quaterniond& q, const Vector3d& t);
  /// Takes the rotation nearest to R. Requires that R is a rotation to about 1e-3.
  Pose(const Matrix3d& R, const Vector3d& t);

  const Quaterniond& q() const { return q_; }
  const Vector3d& t() const { return t_; }
  Matrix3d R() const { return q_.toRotationMatrix(); }
  Eigen::Matrix4d matrix() const;

  Pose inverse() const;
  Pose operator*(const Pose& T_b_c) const;
  Vector3d operator*(const Vector3d& p_b) const;

  bool isFinite() const;

 private:
  Quaterniond q_;
  Vector3d t_;
};

/// Return exponential and logarithm of SE(3), tangent (rho, phi), translation first: Exp(rho, phi) = [Exp(phi),
/// J_l(phi) rho].
Pose expSe3(const Vector6d& tangent);
Vector6d logSe3(const Pose& T);

/// Returns Ad(T) with T Exp(x) T^-1 = Exp(Ad(T) x).
Matrix6d adjoint(const Pose& T);

/// Perturbation used by all estimators and by the covariances of all outputs of stages: boxPlus(T, (rho, phi)) =
/// [Exp(phi) R, t + rho], both in the parent frame. boxMinus(A, B) is the d with A = boxPlus(B, d).
Pose boxPlus(const Pose& T_a_b, const Vector6d& d);
Vector6d boxMinus(const Pose& A, const Pose& B);

/// Return the angle of the rotation between two poses, rad, and the distance of their origins, m.
double angleBetween(const Pose& A, const Pose& B);
double distanceBetween(const Pose& A, const Pose& B);

/// Returns whether the poses are equal within `tolerance` (m for the translation, rad for the rotation).
bool isApprox(const Pose& A, const Pose& B, double tolerance);
/// Prints "t = (x, y, z) m, rotation vector = (a, b, c) rad".
std::ostream& operator<<(std::ostream& out, const Pose& T);

}  // namespace urban_nav_core
