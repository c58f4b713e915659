// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/compose.hpp"

namespace urban_nav_core {

/// From one convention of a pose's tangent to another, and from one body frame to another. "Box" is the convention of
/// everything that leaves a stage (docs/conventions.md): T_a_b = [Exp(phi) R, t + rho], both in the parent frame,
/// translation first.
///
/// d_box = boxFromLeft(T) d_left for T = Exp(d_left) T_mean, the tangent of SE(3) in the parent frame.
Matrix6d boxFromLeft(const Pose& T_a_b);
Matrix6d leftFromBox(const Pose& T_a_b);
/// d_box = boxFromRight(T) d_right for T = T_mean Exp(d_right), the tangent of SE(3) in the child frame.
Matrix6d boxFromRight(const Pose& T_a_b);
Matrix6d rightFromBox(const Pose& T_a_b);

/// J covariance J^T, kept symmetric.
Matrix6d transformCovariance(const Matrix6d& J, const Matrix6d& covariance);
/// The information of d' = J d for that of d, J invertible: J^-T information J^-1. The information may be singular.
Matrix6d transformInformation(const Matrix6d& J_inverse, const Matrix6d& information);
/// Rotation first to translation first, and back: the two halves change places.
Matrix6d swapHalves(const Matrix6d& matrix);

/// T_odom_base for a measured T_odom_camera and a fixed T_base_camera that is known exactly.
PoseWithCovariance baseFromCamera(const PoseWithCovariance& T_odom_camera, const Pose& T_base_camera);
/// T_base1_base2 for a measured T_camera1_camera2.
PoseWithCovariance baseMotionFromCameraMotion(const PoseWithCovariance& T_camera1_camera2, const Pose& T_base_camera);
/// T_first_base in the axes of the first base_link, where `odom` is any frame in which the first pose is known exactly.
PoseWithCovariance relativeToFirst(const PoseWithCovariance& T_odom_base, const Pose& T_odom_first);

/// A covariance for display of a constraint that leaves directions free: the inverse where there is information, 1e6
/// m^2 and 10 rad^2 along the free directions. Translation and rotation are distinguished by `length`, the m that weigh
/// as much as one rad.
Matrix6d covarianceForDisplay(const Matrix6d& information, double length);

}  // namespace urban_nav_core
