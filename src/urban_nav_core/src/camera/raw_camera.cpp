// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/raw_camera.hpp"

#include <ostream>

namespace urban_nav_core {

std::optional<Eigen::Vector2d> RawCamera::project(const Eigen::Vector3d& p_cam) const {
  if (!(p_cam.z() > 0.0)) return std::nullopt;
  const std::optional<Eigen::Vector2d> seen = distortion.distort(p_cam.head<2>() / p_cam.z());
  if (!seen) return std::nullopt;
  return pinhole.project({seen->x(), seen->y(), 1.0});
}

std::optional<Eigen::Vector3d> RawCamera::ray(const Eigen::Vector2d& pixel) const {
  const std::optional<Eigen::Vector2d> ideal = distortion.undistort(pinhole.ray(pixel).head<2>());
  if (!ideal) return std::nullopt;
  return Eigen::Vector3d(ideal->x(), ideal->y(), 1.0);
}

std::ostream& operator<<(std::ostream& out, const RawCamera& camera) {
  return out << camera.pinhole << ", " << camera.distortion;
}

}  // namespace urban_nav_core
