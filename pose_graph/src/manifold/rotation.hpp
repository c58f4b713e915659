// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "pose_graph/problem.hpp"
#include "urban_nav_core/geometry/so3.hpp"

namespace pose_graph {

/// Rotations of the plane and of space under common names. Their tangents have one and three components.
template <int D>
constexpr int kRotationSize = D == 2 ? 1 : 3;
template <int D>
using RotationVector = Eigen::Matrix<double, kRotationSize<D>, 1>;
template <int D>
using Rotation = Eigen::Matrix<double, D, D>;

inline Rotation<2> expRotation(const RotationVector<2>& phi) {
  const double c = std::cos(phi[0]), s = std::sin(phi[0]);
  Rotation<2> R;
  R << c, -s, s, c;
  return R;
}
inline Rotation<3> expRotation(const RotationVector<3>& phi) { return urban_nav_core::expSo3(phi).toRotationMatrix(); }

/// Returns the rotation vector, |phi| <= pi.
inline RotationVector<2> logRotation(const Rotation<2>& R) {
  return RotationVector<2>(std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1)));
}
inline RotationVector<3> logRotation(const Rotation<3>& R) { return urban_nav_core::logSo3(Eigen::Quaterniond(R)); }

/// Returns the matrix of d phi -> d phi x v, the displacement of v by a small rotation.
inline Eigen::Matrix<double, 2, 1> turned(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }
inline Eigen::Matrix3d turned(const Eigen::Vector3d& v) { return -urban_nav_core::skew(v); }

/// Returns the rotation nearest to M in the Frobenius norm; M must not be zero.
Rotation<2> nearestRotation(const Eigen::Matrix2d& M);
Rotation<3> nearestRotation(const Eigen::Matrix3d& M);

/// Returns the rotation without the accumulated round-off of a long product, by one Newton step to the nearest
/// rotation. Otherwise, using the transpose as inverse would double the round-off in each step.
template <int D>
Rotation<D> renormalised(const Rotation<D>& R) {
  return 0.5 * R * (3.0 * Rotation<D>::Identity() - R.transpose() * R);
}

/// Returns the derivative of the end of an edge's lever arm with respect to a move (rho, phi) of T_from_to, both in the
/// axes of `from`.
template <int D>
TangentMatrix<D> leverJacobian(const Edge<D>& edge, const Rigid<D>& from, const Rigid<D>& to) {
  TangentMatrix<D> J = TangentMatrix<D>::Identity();
  if (edge.hasLever())
    J.template topRightCorner<D, kRotationSize<D>>() =
        turned(Eigen::Matrix<double, D, 1>(from.R.transpose() * (to.R * edge.lever)));
  return J;
}

/// Returns T moved by d = (rho, phi): [Exp(phi) R, t + rho], both in the parent frame.
template <int D>
Rigid<D> moved(const Rigid<D>& T, const Tangent<D>& d) {
  return {expRotation(RotationVector<D>(d.template tail<kRotationSize<D>>())) * T.R, T.t + d.template head<D>()};
}

}  // namespace pose_graph
