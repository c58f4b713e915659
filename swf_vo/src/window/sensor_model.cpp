// SPDX-License-Identifier: BSD-3-Clause
#include "window/sensor_model.hpp"

namespace swf_vo {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Minimum depth relative to the first observation: below, the camera has reached or passed the point.
constexpr double kNearest = 1e-3;

Matrix3d cross(const Vector3d& a) {
  Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

}  // namespace

Eigen::Vector4d Anchor::homogeneous(const Vector3d& theta) const {
  Eigen::Vector4d point;
  point.head<3>() = R_odom_anchor * Vector3d(theta.x(), theta.y(), 1.0) + theta.z() * t_odom_anchor;
  point.w() = theta.z();
  return point;
}

PoseMatrices::PoseMatrices(const urban_nav_core::Pose& T_odom_camera)
    : R_camera_odom(T_odom_camera.R().transpose()), t_odom_camera(T_odom_camera.t()) {}

Eigen::Matrix<double, 3, 6> SensorModel::Linearised::pose() const {
  Eigen::Matrix<double, 3, 6> J;
  J.leftCols<3>() = -rho * H;
  J.rightCols<3>() = H * cross(w);
  return J;
}

SensorModel::SensorModel(const urban_nav_core::StereoCamera& camera)
    : fx_(camera.left.fx), fy_(camera.left.fy), cx_(camera.left.cx), cy_(camera.left.cy), baseline_(camera.baseline) {}

bool SensorModel::predict(const Anchor& anchor, const Vector3d& theta, const PoseMatrices& pose, Vector3d& z) const {
  const Vector3d w = anchor.R_odom_anchor * Vector3d(theta.x(), theta.y(), 1.0) +
                     theta.z() * (anchor.t_odom_anchor - pose.t_odom_camera);
  const Vector3d q = pose.R_camera_odom * w;
  if (!(q.z() > kNearest)) return false;
  const double inverse = 1.0 / q.z();
  const double u = fx_ * q.x() * inverse + cx_;
  z = Vector3d(u, fy_ * q.y() * inverse + cy_, u - fx_ * baseline_ * theta.z() * inverse);
  return true;
}

bool SensorModel::linearise(const Anchor& anchor, const Vector3d& theta, const PoseMatrices& pose,
                            Linearised& result) const {
  const Vector3d towards = anchor.t_odom_anchor - pose.t_odom_camera;
  result.rho = theta.z();
  result.w = anchor.R_odom_anchor * Vector3d(theta.x(), theta.y(), 1.0) + theta.z() * towards;
  const Vector3d q = pose.R_camera_odom * result.w;
  if (!(q.z() > kNearest)) return false;
  const double inverse = 1.0 / q.z();
  const Vector3d x_row = pose.R_camera_odom.row(0), y_row = pose.R_camera_odom.row(1),
                 z_row = pose.R_camera_odom.row(2);
  result.H.row(0) = fx_ * inverse * (x_row - q.x() * inverse * z_row);
  result.H.row(1) = fy_ * inverse * (y_row - q.y() * inverse * z_row);
  result.H.row(2) = fx_ * inverse * (x_row - (q.x() - baseline_ * theta.z()) * inverse * z_row);
  result.landmark.leftCols<2>().noalias() = result.H * anchor.R_odom_anchor.leftCols<2>();
  result.landmark.col(2).noalias() = result.H * towards;
  result.landmark(2, 2) -= fx_ * baseline_ * inverse;
  return true;
}

Vector3d SensorModel::invert(const Vector3d& z) const {
  return Vector3d((z.x() - cx_) / fx_, (z.y() - cy_) / fy_, (z.x() - z.z()) / (fx_ * baseline_));
}

Eigen::Matrix2d SensorModel::bearing(const Eigen::Matrix2d& covariance_px) const {
  const Eigen::Vector2d per_px(1.0 / fx_, 1.0 / fy_);
  return per_px.asDiagonal() * covariance_px * per_px.asDiagonal();
}

}  // namespace swf_vo
