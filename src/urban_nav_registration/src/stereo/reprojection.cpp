// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/reprojection.hpp"

namespace urban_nav_registration {

using urban_nav_core::Pose;
using urban_nav_core::skew;
using urban_nav_core::StereoCamera;

namespace {

constexpr double kLeastDepth = 1e-3;  // ratio of z to the depth in its own view

}  // namespace

double inverseDepth(const PointMeasurement& measurement, const StereoCamera& camera) {
  return (measurement.disparity - camera.disparity_offset) / (camera.left.fx * camera.baseline);
}

MeasurementResidual computeResidual(const PointMeasurement& measurement, const StereoCamera& camera, const Pose& T_a_b,
                                    double offset, double inverse_depth) {
  MeasurementResidual result;
  const auto& c = camera.left;
  const double per_depth = c.fx * camera.baseline, rho = inverse_depth;
  const Eigen::Matrix3d R = T_a_b.R();
  const Eigen::Vector3d& t = T_a_b.t();
  // p: point in the other view divided by the depth in its own view, so that far points need no special case
  Eigen::Vector3d p, p_by_depth;
  Eigen::Matrix<double, 3, 6> p_by_pose;
  if (measurement.of_a) {
    const Eigen::Vector3d q = measurement.ray - t * rho;
    p = R.transpose() * q;
    p_by_depth = -(R.transpose() * t);
    p_by_pose.leftCols<3>() = -rho * R.transpose();
    p_by_pose.rightCols<3>() = R.transpose() * skew(q);
  } else {
    const Eigen::Vector3d turned = R * measurement.ray;
    p = turned + t * rho;
    p_by_depth = t;
    p_by_pose.leftCols<3>() = rho * Eigen::Matrix3d::Identity();
    p_by_pose.rightCols<3>() = -skew(turned);
  }
  if (!(p.z() > kLeastDepth)) return result;
  result.visible = true;
  const double iz = 1.0 / p.z(), x = p.x() * iz, y = p.y() * iz;
  Eigen::Matrix<double, 2, 3> pixel_by_p;
  pixel_by_p << c.fx * iz, 0.0, -c.fx * x * iz, 0.0, c.fy * iz, -c.fy * y * iz;

  result.e[0] = measurement.disparity - (per_depth * rho + camera.disparity_offset + offset);
  result.J(0, kOfOffset) = 1.0;
  result.J(0, kOfDepth) = per_depth;
  result.e.segment<2>(1) = measurement.pixel - Eigen::Vector2d(c.fx * x + c.cx, c.fy * y + c.cy);
  result.J.block<2, 6>(1, 0) = pixel_by_p * p_by_pose;
  result.J.block<2, 1>(1, kOfDepth) = pixel_by_p * p_by_depth;
  if (measurement.other_sigma > 0.0) {
    const double disparity = per_depth * rho * iz;
    result.e[3] = measurement.other_disparity - (disparity + camera.disparity_offset + offset);
    const double by_z = -disparity * iz;
    result.J.block<1, 6>(3, 0) = by_z * p_by_pose.row(2);
    result.J(3, kOfOffset) = 1.0;
    result.J(3, kOfDepth) = per_depth * iz + by_z * p_by_depth.z();
  }
  return result;
}

}  // namespace urban_nav_registration
