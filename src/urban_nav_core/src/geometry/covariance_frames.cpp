// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/covariance_frames.hpp"

#include <algorithm>

#include "urban_nav_core/geometry/dense.hpp"

namespace urban_nav_core {
namespace {

Matrix6d withCoupling(const Matrix3d& coupling) {
  Matrix6d M = Matrix6d::Identity();
  M.topRightCorner<3, 3>() = coupling;
  return M;
}

Matrix6d twice(const Matrix3d& R) {
  Matrix6d M = Matrix6d::Zero();
  M.topLeftCorner<3, 3>() = R;
  M.bottomRightCorner<3, 3>() = R;
  return M;
}

}  // namespace

// Exp(rho, phi) T moves the origin of b by rho + phi x t; the box tangent moves it by rho only.
Matrix6d boxFromLeft(const Pose& T_a_b) { return withCoupling(-skew(T_a_b.t())); }
Matrix6d leftFromBox(const Pose& T_a_b) { return withCoupling(skew(T_a_b.t())); }
Matrix6d boxFromRight(const Pose& T_a_b) { return twice(T_a_b.R()); }
Matrix6d rightFromBox(const Pose& T_a_b) { return twice(T_a_b.R().transpose()); }

Matrix6d transformCovariance(const Matrix6d& J, const Matrix6d& covariance) {
  const Matrix6d M = J * covariance * J.transpose();
  return 0.5 * (M + M.transpose());
}

Matrix6d transformInformation(const Matrix6d& J_inverse, const Matrix6d& information) {
  return transformCovariance(J_inverse.transpose(), information);
}

Matrix6d swapHalves(const Matrix6d& matrix) {
  Matrix6d M;
  M << matrix.bottomRightCorner<3, 3>(), matrix.bottomLeftCorner<3, 3>(), matrix.topRightCorner<3, 3>(),
      matrix.topLeftCorner<3, 3>();
  return M;
}

PoseWithCovariance baseFromCamera(const PoseWithCovariance& T_odom_camera, const Pose& T_base_camera) {
  const Composition c = compose(T_odom_camera.pose, T_base_camera.inverse());
  return {c.T_a_c, transformCovariance(c.J1, T_odom_camera.covariance)};
}

PoseWithCovariance baseMotionFromCameraMotion(const PoseWithCovariance& T_camera1_camera2, const Pose& T_base_camera) {
  const Composition inner = compose(T_base_camera, T_camera1_camera2.pose);
  const Composition outer = compose(inner.T_a_c, T_base_camera.inverse());
  return {outer.T_a_c, transformCovariance(outer.J1 * inner.J2, T_camera1_camera2.covariance)};
}

PoseWithCovariance relativeToFirst(const PoseWithCovariance& T_odom_base, const Pose& T_odom_first) {
  const Between b = between(T_odom_first, T_odom_base.pose);
  return {b.T_b_c, transformCovariance(b.J2, T_odom_base.covariance)};
}

Matrix6d covarianceForDisplay(const Matrix6d& information, double length) {
  constexpr double kFreeTranslation = 1e6, kFreeRotation = 10.0, kSingular = 1e-9;
  Vector6d unit;  // scales that make the six directions comparable
  unit << Vector3d::Constant(length), Vector3d::Ones();
  const auto eigen = symmetricEigen(Eigen::MatrixXd(unit.asDiagonal() * information * unit.asDiagonal()));
  Matrix6d covariance = Matrix6d::Zero();
  if (!eigen) return covariance + Vector6d(unit.cwiseAbs2() * kFreeRotation).asDiagonal().toDenseMatrix();
  const double limit = kSingular * eigen->values.maxCoeff();
  for (int i = 0; i < 6; ++i) {
    const Vector6d v = eigen->vectors.col(i);
    const double translation_share = v.head<3>().squaredNorm();
    const double free =
        translation_share * kFreeTranslation / (length * length) + (1.0 - translation_share) * kFreeRotation;
    const double variance = eigen->values[i] > limit ? std::min(1.0 / eigen->values[i], free) : free;
    covariance += variance * (unit.asDiagonal() * v) * (unit.asDiagonal() * v).transpose();
  }
  return covariance;
}

}  // namespace urban_nav_core
