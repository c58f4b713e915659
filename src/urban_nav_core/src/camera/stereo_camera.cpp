// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/stereo_camera.hpp"

#include <cmath>
#include <ostream>

namespace urban_nav_core {
namespace {

// At smaller disparities a point is too far to be useful and its coordinates may overflow.
constexpr double kLeastDisparity = 1e-9;  // px

}  // namespace

std::optional<StereoCamera::Pixel> StereoCamera::project(const Eigen::Vector3d& p_cam) const {
  const std::optional<Eigen::Vector2d> pixel = left.project(p_cam);
  if (!pixel) return std::nullopt;
  return Pixel(pixel->x(), pixel->y(), pixel->x() - left.fx * baseline / p_cam.z() - disparity_offset);
}

Eigen::Matrix3d StereoCamera::projectJacobian(const Eigen::Vector3d& p_cam) const {
  Eigen::Matrix3d J;
  J.topRows<2>() = left.projectJacobian(p_cam);
  J.row(2) = J.row(0);
  J(2, 2) += left.fx * baseline / (p_cam.z() * p_cam.z());
  return J;
}

std::optional<Eigen::Vector3d> StereoCamera::triangulate(const Pixel& pixel) const {
  const double disparity = pixel(0) - pixel(2) - disparity_offset;
  if (!(disparity > kLeastDisparity)) return std::nullopt;
  return left.ray(pixel.head<2>()) * (left.fx * baseline / disparity);
}

Eigen::Matrix3d StereoCamera::triangulateJacobian(const Pixel& pixel) const {
  const double disparity = pixel(0) - pixel(2) - disparity_offset;
  const double z = left.fx * baseline / disparity;
  const Eigen::Vector3d p_by_disparity = left.ray(pixel.head<2>()) * (-z / disparity);
  Eigen::Matrix3d J;
  J.col(0) = p_by_disparity + Eigen::Vector3d(z / left.fx, 0.0, 0.0);
  J.col(1) = Eigen::Vector3d(0.0, z / left.fy, 0.0);
  J.col(2) = -p_by_disparity;
  return J;
}

Eigen::Matrix3d StereoCamera::triangulateCovariance(const Pixel& pixel, const Eigen::Matrix3d& pixel_covariance) const {
  const Eigen::Matrix3d J = triangulateJacobian(pixel);
  return J * pixel_covariance * J.transpose();
}

bool isApprox(const StereoCamera& a, const StereoCamera& b, double tolerance) {
  return isApprox(a.left, b.left, tolerance) && std::abs(a.baseline - b.baseline) <= tolerance &&
         std::abs(a.disparity_offset - b.disparity_offset) <= tolerance;
}

std::ostream& operator<<(std::ostream& out, const StereoCamera& camera) {
  out << camera.left << ", baseline = " << camera.baseline << " m";
  if (camera.disparity_offset != 0.0) out << ", disparity offset = " << camera.disparity_offset << " px";
  return out;
}

}  // namespace urban_nav_core
