// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace urban_nav_core {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Returns the skew-symmetric matrix with skew(a) b = a x b.
Matrix3d skew(const Vector3d& a);

/// Returns the rotation by |phi| rad about phi. Exact to machine precision at any angle, the identity at zero.
Quaterniond expSo3(const Vector3d& phi);

/// Returns the rotation vector of q, |phi| <= pi. Exact near 0 and near pi. q need not be exactly normalised; q and -q
/// give the same result.
Vector3d logSo3(const Quaterniond& q);

/// Returns the left Jacobian of SO(3): Exp(phi + d) = Exp(J d) Exp(phi) to first order (Barfoot, State Estimation for
/// Robotics, eq. 7.77).
Matrix3d leftJacobianSo3(const Vector3d& phi);
/// Returns the inverse of the left Jacobian (Barfoot, eq. 7.76), for |phi| < 2 pi.
Matrix3d leftJacobianInverseSo3(const Vector3d& phi);

}  // namespace urban_nav_core
