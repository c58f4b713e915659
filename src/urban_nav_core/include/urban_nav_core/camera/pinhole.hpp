// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <optional>

namespace urban_nav_core {

/// Pinhole camera without distortion. Pixel centres are integers: the top left pixel covers (-0.5, -0.5)...(0.5, 0.5).
/// Optical axes: z forward, x right, y down.
struct Pinhole {
  double fx = 0.0, fy = 0.0;  ///< focal lengths, px
  double cx = 0.0, cy = 0.0;  ///< principal point, px
  int width = 0, height = 0;  ///< px

  /// Returns the pixel of a point in the optical frame, inside the image or not; empty if the point is not in front of
  /// the camera (z > 1 um).
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_cam) const;
  /// Returns d(u, v)/d(p_cam) for a point in front of the camera.
  Eigen::Matrix<double, 2, 3> projectJacobian(const Eigen::Vector3d& p_cam) const;
  /// Returns the direction of a pixel, with z = 1.
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
  /// Returns whether the position lies on a pixel of the image.
  bool contains(const Eigen::Vector2d& pixel) const;
};

bool isApprox(const Pinhole& a, const Pinhole& b, double tolerance_px);
std::ostream& operator<<(std::ostream& out, const Pinhole& camera);

}  // namespace urban_nav_core
