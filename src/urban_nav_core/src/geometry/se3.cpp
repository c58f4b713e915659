// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/se3.hpp"

#include <Eigen/LU>
#include <cassert>
#include <cmath>
#include <ostream>

#include "series.hpp"

namespace urban_nav_core {
namespace {

// Newton's iteration for the orthogonal factor of the polar decomposition: quadratic convergence, four steps from 1e-1
// to machine precision.
Matrix3d nearestRotation(const Matrix3d& R) {
  constexpr int kSteps = 5;
  Matrix3d X = R;
  for (int i = 0; i < kSteps; ++i) X = (0.5 * (X + X.inverse().transpose())).eval();
  return X;
}

// Normalising a normalised quaternion could alter its last bit. The bound is above the rounding error of a
// normalisation, which makes it idempotent.
Quaterniond unit(const Quaterniond& q) {
  constexpr double kRounding = 1e-15;
  return std::abs(q.squaredNorm() - 1.0) <= kRounding ? q : q.normalized();
}

}  // namespace

Pose::Pose(const Quaterniond& q, const Vector3d& t) : q_(unit(q)), t_(t) {
  assert(std::isfinite(q.squaredNorm()) && q.squaredNorm() > 0.0);
}

Pose::Pose(const Matrix3d& R, const Vector3d& t) : q_(unit(Quaterniond(nearestRotation(R)))), t_(t) {
  assert(q_.coeffs().allFinite());
}

Eigen::Matrix4d Pose::matrix() const {
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.topLeftCorner<3, 3>() = R();
  M.topRightCorner<3, 1>() = t_;
  return M;
}

Pose Pose::inverse() const {
  Pose T_b_a;
  T_b_a.q_ = q_.conjugate();
  T_b_a.t_ = -(T_b_a.q_ * t_);
  return T_b_a;
}

Pose Pose::operator*(const Pose& T_b_c) const { return Pose(q_ * T_b_c.q_, t_ + q_ * T_b_c.t_); }

Vector3d Pose::operator*(const Vector3d& p_b) const { return q_ * p_b + t_; }

bool Pose::isFinite() const { return q_.coeffs().allFinite() && t_.allFinite(); }

Pose expSe3(const Vector6d& tangent) {
  const Vector3d rho = tangent.head<3>();
  const Vector3d phi = tangent.tail<3>();
  return Pose(expSo3(phi), leftJacobianSo3(phi) * rho);
}

Vector6d logSe3(const Pose& T) {
  Vector6d tangent;
  tangent.tail<3>() = logSo3(T.q());
  tangent.head<3>() = leftJacobianInverseSo3(tangent.tail<3>()) * T.t();
  return tangent;
}

Matrix6d adjoint(const Pose& T) {
  const Matrix3d R = T.R();
  Matrix6d A;
  A << R, skew(T.t()) * R, Matrix3d::Zero(), R;
  return A;
}

Pose boxPlus(const Pose& T_a_b, const Vector6d& d) {
  return Pose(expSo3(d.tail<3>()) * T_a_b.q(), T_a_b.t() + d.head<3>());
}

Vector6d boxMinus(const Pose& A, const Pose& B) {
  Vector6d d;
  d << A.t() - B.t(), logSo3(A.q() * B.q().conjugate());
  return d;
}

double angleBetween(const Pose& A, const Pose& B) { return logSo3(A.q() * B.q().conjugate()).norm(); }

double distanceBetween(const Pose& A, const Pose& B) { return (A.t() - B.t()).norm(); }

bool isApprox(const Pose& A, const Pose& B, double tolerance) {
  return distanceBetween(A, B) <= tolerance && angleBetween(A, B) <= tolerance;
}

std::ostream& operator<<(std::ostream& out, const Pose& T) {
  const Vector3d t = T.t();
  const Vector3d r = logSo3(T.q());
  return out << "t = (" << t.x() << ", " << t.y() << ", " << t.z() << ") m, rotation vector = (" << r.x() << ", "
             << r.y() << ", " << r.z() << ") rad";
}

}  // namespace urban_nav_core
