// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <optional>

#include "urban_nav_core/camera/pinhole.hpp"

namespace urban_nav_core {

/// Rectified stereo pair: one pinhole for both images, the right camera `baseline` metres along the left x axis. A
/// stereo pixel is (u_left, v, u_right) in px; its disparity u_left - u_right is fx baseline / z + disparity_offset.
struct StereoCamera {
  Pinhole left;
  double baseline = 0.0;  ///< m, > 0
  double disparity_offset =
      0.0;  ///< px, disparity at infinity: cx_left - cx_right where the images have different principal points

  using Pixel = Eigen::Vector3d;  ///< u_left, v, u_right

  /// Returns the stereo pixel of a point in the left optical frame; empty if the point is not in front of the camera.
  std::optional<Pixel> project(const Eigen::Vector3d& p_cam) const;
  /// Returns d(u_left, v, u_right)/d(p_cam) for a point in front of the camera.
  Eigen::Matrix3d projectJacobian(const Eigen::Vector3d& p_cam) const;
  /// Returns the point in the left optical frame; empty unless the disparity is positive.
  std::optional<Eigen::Vector3d> triangulate(const Pixel& pixel) const;
  /// Returns d(p_cam)/d(u_left, v, u_right) for a positive disparity.
  Eigen::Matrix3d triangulateJacobian(const Pixel& pixel) const;
  /// Returns the first-order covariance of triangulate(), m^2, for a 3x3 covariance of the stereo pixel, px^2.
  /// Underestimates where the standard deviation of the disparity is not small compared with the disparity.
  Eigen::Matrix3d triangulateCovariance(const Pixel& pixel, const Eigen::Matrix3d& pixel_covariance) const;
};

bool isApprox(const StereoCamera& a, const StereoCamera& b, double tolerance);
std::ostream& operator<<(std::ostream& out, const StereoCamera& camera);

}  // namespace urban_nav_core
