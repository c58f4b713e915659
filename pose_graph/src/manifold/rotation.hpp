// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "pose_graph/problem.hpp"
#include "urban_nav_core/geometry/so3.hpp"

namespace pose_graph {

/// Rotations of the plane and of space under one name. The tangent of the plane is one number, that of space three.
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

/// |phi| <= pi.
inline RotationVector<2> logRotation(const Rotation<2>& R) {
  return RotationVector<2>(std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1)));
}
inline RotationVector<3> logRotation(const Rotation<3>& R) { return urban_nav_core::logSo3(Eigen::Quaterniond(R)); }

/// d phi x v for a small turn d phi of v: the matrix that it is multiplied by.
inline Eigen::Matrix<double, 2, 1> turned(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }
inline Eigen::Matrix3d turned(const Eigen::Vector3d& v) { return -urban_nav_core::skew(v); }

/// The rotation nearest to M in the Frobenius norm; M may be any matrix but zero.
Rotation<2> nearestRotation(const Eigen::Matrix2d& M);
Rotation<3> nearestRotation(const Eigen::Matrix3d& M);

/// A rotation without the round-off of a long product, which a transpose taken for an inverse would double at each
/// step: one step of Newton's method to the nearest rotation.
template <int D>
Rotation<D> renormalised(const Rotation<D>& R) {
  return 0.5 * R * (3.0 * Rotation<D>::Identity() - R.transpose() * R);
}

/// Derivative of the end of an edge's lever arm by a move (rho, phi) of T_from_to, both in the axes of `from`.
template <int D>
TangentMatrix<D> leverJacobian(const Edge<D>& edge, const Rigid<D>& from, const Rigid<D>& to) {
  TangentMatrix<D> J = TangentMatrix<D>::Identity();
  if (edge.hasLever())
    J.template topRightCorner<D, kRotationSize<D>>() =
        turned(Eigen::Matrix<double, D, 1>(from.R.transpose() * (to.R * edge.lever)));
  return J;
}

/// T moved by d = (rho, phi): [Exp(phi) R, t + rho], both in the parent frame.
template <int D>
Rigid<D> moved(const Rigid<D>& T, const Tangent<D>& d) {
  return {expRotation(RotationVector<D>(d.template tail<kRotationSize<D>>())) * T.R, T.t + d.template head<D>()};
}

}  // namespace pose_graph
