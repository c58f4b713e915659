// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace urban_nav_sim {

/// A pinhole camera with the plumb-bob distortion (Brown 1966; coefficients in OpenCV's order). Pixel centres have
/// integer coordinates, u to the right, v down; camera axes: z forward, x right, y down. Deliberately independent of
/// urban_nav_core, since a common error of simulator and estimator would cancel.
struct Lens {
  int width = 0, height = 0;                      ///< px
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< px
  std::array<double, 5> distortion{};             ///< k1, k2, p1, p2, k3

  bool isDistorted() const;
  /// Returns the distorted point of an ideal image point (x/z, y/z).
  Eigen::Vector2d distorted(const Eigen::Vector2d& ideal) const;
  /// Returns the Jacobian of distorted().
  Eigen::Matrix2d distortionJacobian(const Eigen::Vector2d& ideal) const;
  /// Returns the pixel of a point in camera axes (m), also outside the image; nullopt if it is not in front, or beyond
  /// the monotonic range of the polynomial.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_cam) const;
  /// Returns the ideal point of a pixel, by Newton's method to 1e-12; nullopt if the lens has none.
  std::optional<Eigen::Vector2d> idealAt(const Eigen::Vector2d& pixel) const;
};

}  // namespace urban_nav_sim
