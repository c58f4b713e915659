// SPDX-License-Identifier: BSD-3-Clause
#include "camera/lens.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace urban_nav_sim {

bool Lens::isDistorted() const {
  return std::any_of(distortion.begin(), distortion.end(), [](double c) { return c != 0.0; });
}

Eigen::Vector2d Lens::distorted(const Eigen::Vector2d& ideal) const {
  const auto& [k1, k2, p1, p2, k3] = distortion;
  const double x = ideal.x(), y = ideal.y(), r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

Eigen::Matrix2d Lens::distortionJacobian(const Eigen::Vector2d& ideal) const {
  const auto& [k1, k2, p1, p2, k3] = distortion;
  const double x = ideal.x(), y = ideal.y(), r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));  // d radial / dx = slope x
  Eigen::Matrix2d J;
  J(0, 0) = radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x;
  J(0, 1) = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y;
  J(1, 0) = J(0, 1);
  J(1, 1) = radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
  return J;
}

std::optional<Eigen::Vector2d> Lens::project(const Eigen::Vector3d& p_cam) const {
  if (!(p_cam.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d ideal = p_cam.head<2>() / p_cam.z();
  if (isDistorted() && !(distortionJacobian(ideal).determinant() > 0.0)) return std::nullopt;
  const Eigen::Vector2d d = distorted(ideal);
  return Eigen::Vector2d(fx * d.x() + cx, fy * d.y() + cy);
}

std::optional<Eigen::Vector2d> Lens::idealAt(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d wanted((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  if (!isDistorted()) return wanted;
  Eigen::Vector2d ideal = wanted;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d off = distorted(ideal) - wanted;
    const Eigen::Matrix2d J = distortionJacobian(ideal);
    if (!(J.determinant() > 1e-6)) return std::nullopt;
    Eigen::Vector2d step = J.inverse() * off;
    // Full steps overshoot near where the polynomial folds back.
    const double length = step.norm();
    if (length > 0.3) step *= 0.3 / length;
    ideal -= step;
    if (length < 1e-13) break;
  }
  if (!((distorted(ideal) - wanted).norm() < 1e-12)) return std::nullopt;
  return ideal;
}

}  // namespace urban_nav_sim
