// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/pinhole.hpp"

#include <cmath>
#include <ostream>

namespace urban_nav_core {
namespace {

// Nearer points are not projected: the quotient is meaningless and may overflow.
constexpr double kNearest = 1e-6;  // m

}  // namespace

std::optional<Eigen::Vector2d> Pinhole::project(const Eigen::Vector3d& p_cam) const {
  if (!(p_cam.z() > kNearest)) return std::nullopt;
  const double inverse_z = 1.0 / p_cam.z();
  return Eigen::Vector2d(fx * p_cam.x() * inverse_z + cx, fy * p_cam.y() * inverse_z + cy);
}

Eigen::Matrix<double, 2, 3> Pinhole::projectJacobian(const Eigen::Vector3d& p_cam) const {
  const double inverse_z = 1.0 / p_cam.z();
  const double x = p_cam.x() * inverse_z;
  const double y = p_cam.y() * inverse_z;
  Eigen::Matrix<double, 2, 3> J;
  J << fx * inverse_z, 0.0, -fx * x * inverse_z,  //
      0.0, fy * inverse_z, -fy * y * inverse_z;
  return J;
}

Eigen::Vector3d Pinhole::ray(const Eigen::Vector2d& pixel) const {
  return {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy, 1.0};
}

bool Pinhole::contains(const Eigen::Vector2d& pixel) const {
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < width - 0.5 && pixel.y() < height - 0.5;
}

bool isApprox(const Pinhole& a, const Pinhole& b, double tolerance_px) {
  const auto near = [tolerance_px](double x, double y) { return std::abs(x - y) <= tolerance_px; };
  return a.width == b.width && a.height == b.height && near(a.fx, b.fx) && near(a.fy, b.fy) && near(a.cx, b.cx) &&
         near(a.cy, b.cy);
}

std::ostream& operator<<(std::ostream& out, const Pinhole& camera) {
  return out << camera.width << " x " << camera.height << " px, fx = " << camera.fx << ", fy = " << camera.fy
             << ", cx = " << camera.cx << ", cy = " << camera.cy << " px";
}

}  // namespace urban_nav_core
