// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/surface.hpp"

#include <algorithm>

namespace urban_nav_core {

Eigen::Vector3d surfaceThrough(const StereoCamera& camera, const StereoCamera::Pixel& pixel,
                               const Eigen::Vector2d& slopes) {
  // d(u, v) = fx B / z and 1 / z = plane . (x, y, 1), so the slopes are B (plane_x, plane_y fx / fy).
  const auto& c = camera.left;
  const double inverse_depth = (pixel.x() - pixel.z() - camera.disparity_offset) / (c.fx * camera.baseline);
  const double x = (pixel.x() - c.cx) / c.fx, y = (pixel.y() - c.cy) / c.fy;
  return leaning(camera, {x, y, 1.0}, inverse_depth, slopes / camera.baseline);
}

Eigen::Vector3d leaning(const StereoCamera& camera, const Eigen::Vector3d& ray, double inverse_depth,
                        const Eigen::Vector2d& slant) {
  const Eigen::Vector2d plane(slant.x(), slant.y() * camera.left.fy / camera.left.fx);
  return {plane.x(), plane.y(), inverse_depth - plane.dot(ray.head<2>())};
}

Eigen::Vector3d surfaceAt(const Eigen::Vector3d& plane, const Eigen::Vector3d& ray, double inverse_depth) {
  const double at_ray = plane.dot(ray);
  if (at_ray > 1e-9 && inverse_depth > 0.0 && inverse_depth < 4.0 * at_ray) return inverse_depth / at_ray * plane;
  return {0.0, 0.0, std::max(inverse_depth, 0.0)};
}

std::optional<PatchWarp> warpOfSurface(const StereoCamera& camera, const Eigen::Vector3d& plane,
                                       const Eigen::Vector3d& ray, const Pose& T_to_from) {
  const Eigen::Matrix3d H = T_to_from.R() + T_to_from.t() * plane.transpose();
  const Eigen::Vector3d p = H * ray;
  if (!(p.z() > 0.05)) return std::nullopt;
  const double x = p.x() / p.z(), y = p.y() / p.z();
  const double aspect = camera.left.fx / camera.left.fy;
  Eigen::Matrix2d A;
  A << H(0, 0) - x * H(2, 0), (H(0, 1) - x * H(2, 1)) * aspect, (H(1, 0) - y * H(2, 0)) / aspect, H(1, 1) - y * H(2, 1);
  const Eigen::Vector2d bend(H(2, 0) / camera.left.fx, H(2, 1) / camera.left.fy);
  return PatchWarp(A / p.z(), bend / p.z());
}

}  // namespace urban_nav_core
