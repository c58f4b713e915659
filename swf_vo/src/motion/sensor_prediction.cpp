// SPDX-License-Identifier: BSD-3-Clause
#include "motion/sensor_prediction.hpp"

#include "urban_nav_core/geometry/small_matrices.hpp"

namespace swf_vo {

using urban_nav_core::Pose;

namespace {

/// Transforms the motion of base_link to that of the camera: (rho, phi) of boxPlus, in `from`.
ProcessInput inCamera(const urban_nav_core::Reckoned& base, const Pose& T_base_camera) {
  // With X = T_base_camera, T_camera = X^-1 T X: phi is rotated to the camera axes, and t changes by phi x (R t_X).
  ProcessInput u;
  u.T_from_to = T_base_camera.inverse() * base.T_from_to * T_base_camera;
  const urban_nav_core::Matrix3d Rt = T_base_camera.R().transpose();
  if (!base.has_translation) {
    const urban_nav_core::Matrix3d rotation = Rt * base.covariance.bottomRightCorner<3, 3>() * Rt.transpose();
    u.T_from_to = Pose(u.T_from_to.q(), urban_nav_core::Vector3d::Zero());
    u.information.bottomRightCorner<3, 3>() = urban_nav_core::SmallCholesky<3>(rotation).inverse();
    return u;
  }
  urban_nav_core::Matrix6d M = urban_nav_core::Matrix6d::Zero();
  M.topLeftCorner<3, 3>() = M.bottomRightCorner<3, 3>() = Rt;
  M.topRightCorner<3, 3>() = -Rt * urban_nav_core::skew(base.T_from_to.q() * T_base_camera.t());
  u.information = urban_nav_core::SmallCholesky<6>(M * base.covariance * M.transpose()).inverse();
  return u;
}

}  // namespace

std::optional<ProcessInput> predictCamera(const urban_nav_core::MotionSensors& sensors, urban_nav_core::StampNs from,
                                          urban_nav_core::StampNs to, const Pose& T_odom_camera,
                                          const Pose& T_base_camera) {
  const Pose T_odom_base = T_odom_camera * T_base_camera.inverse();
  const std::optional<urban_nav_core::Reckoned> reckoned = sensors.predict(from, to, T_odom_base.q());
  if (!reckoned) return std::nullopt;
  const ProcessInput u = inCamera(*reckoned, T_base_camera);
  if (!u.T_from_to.isFinite() || !u.information.allFinite()) return std::nullopt;
  return u;
}

urban_nav_core::MeasuredStep toMeasuredStep(const Settled& settled) {
  urban_nav_core::MeasuredStep step;
  step.frame = settled.frame;
  step.stamp = settled.stamp;
  step.step = settled.from_previous;
  step.q_odom_base = settled.T_odom_base.pose.q();
  step.health = settled.status.health;
  return step;
}

urban_nav_core::MeasuredStep toMeasuredStep(urban_nav_core::StampNs from, urban_nav_core::StampNs to,
                                            const Pose& T_from_to, const Pose& T_base_camera) {
  urban_nav_core::MeasuredStep step;
  step.step.from = from;
  step.stamp = step.step.to = to;
  step.step.T_from_to = T_base_camera * T_from_to * T_base_camera.inverse();
  return step;
}

}  // namespace swf_vo
