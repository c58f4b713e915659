// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace urban_nav_sim {

/// A pinhole camera with the plumb-bob distortion (Brown 1966; coefficients in OpenCV's order). Pixel centres
/// have whole coordinates, u to the right, v down; camera axes: z forward, x right, y down. Written apart from
/// urban_nav_core on purpose: an error that simulator and estimator share would cancel and never be seen.
struct Lens {
  int width = 0, height = 0;                      ///< px
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< px
  std::array<double, 5> distortion{};             ///< k1, k2, p1, p2, k3

  bool isDistorted() const;
  /// Where an ideal image point (x/z, y/z) is projected by the lens, in the same units.
  Eigen::Vector2d distorted(const Eigen::Vector2d& ideal) const;
  /// How that changes with the ideal point.
  Eigen::Matrix2d distortionJacobian(const Eigen::Vector2d& ideal) const;
  /// Pixel of a point in camera axes (m); also of points outside the image. Empty if it is not in front, or so far
  /// aside that the polynomial folds back.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_cam) const;
  /// The ideal point that is seen at a pixel, by Newton's method to 1e-12. Empty if the lens shows nothing there.
  std::optional<Eigen::Vector2d> idealAt(const Eigen::Vector2d& pixel) const;
};

}  // namespace urban_nav_sim
