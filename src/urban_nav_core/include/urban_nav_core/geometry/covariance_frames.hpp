// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/compose.hpp"

namespace urban_nav_core {

/// Conversions of covariances between tangent conventions and between body frames. "Box" is the convention of all
/// outputs of stages (docs/conventions.md): T_a_b = [Exp(phi) R, t + rho], both in the parent frame, translation first.
///
/// d_box = boxFromLeft(T) d_left for T = Exp(d_left) T_mean, the tangent of SE(3) in the parent frame.
Matrix6d boxFromLeft(const Pose& T_a_b);
Matrix6d leftFromBox(const Pose& T_a_b);
/// d_box = boxFromRight(T) d_right for T = T_mean Exp(d_right), the tangent of SE(3) in the child frame.
Matrix6d boxFromRight(const Pose& T_a_b);
Matrix6d rightFromBox(const Pose& T_a_b);

/// Returns J covariance J^T, exactly symmetric.
Matrix6d transformCovariance(const Matrix6d& J, const Matrix6d& covariance);
/// Returns the information of d' = J d from that of d: J^-T information J^-1, J invertible. The information may be
/// singular.
Matrix6d transformInformation(const Matrix6d& J_inverse, const Matrix6d& information);
/// Exchanges the translation and rotation blocks (rotation first to translation first, and back).
Matrix6d swapHalves(const Matrix6d& matrix);

/// Returns T_odom_base from T_odom_camera; T_base_camera is constant and exact.
PoseWithCovariance baseFromCamera(const PoseWithCovariance& T_odom_camera, const Pose& T_base_camera);
/// Returns T_base1_base2 from T_camera1_camera2; T_base_camera is constant and exact.
PoseWithCovariance baseMotionFromCameraMotion(const PoseWithCovariance& T_camera1_camera2, const Pose& T_base_camera);
/// Returns T_first_base in the axes of the first base_link. `odom` may be any frame in which the first pose is known
/// exactly.
PoseWithCovariance relativeToFirst(const PoseWithCovariance& T_odom_base, const Pose& T_odom_first);

/// Returns a covariance for the display of a constraint with unobserved directions: the inverse in directions with
/// information, 1e6 m^2 and 10 rad^2 in the others. `length`, m: the translation that counts as one rad when directions
/// are compared.
Matrix6d covarianceForDisplay(const Matrix6d& information, double length);

}  // namespace urban_nav_core
