// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <optional>

#include "urban_nav_core/camera/distortion.hpp"
#include "urban_nav_core/camera/pinhole.hpp"

namespace urban_nav_core {

/// Unrectified camera: a pinhole with lens distortion.
struct RawCamera {
  Pinhole pinhole;
  Distortion distortion;

  /// Returns the pixel of a point in the optical frame, inside the image or not; empty behind the camera and beyond the
  /// fold of the distortion.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_cam) const;
  /// Returns the direction of a pixel, with z = 1; empty beyond the fold of the distortion.
  std::optional<Eigen::Vector3d> ray(const Eigen::Vector2d& pixel) const;
};

std::ostream& operator<<(std::ostream& out, const RawCamera& camera);

}  // namespace urban_nav_core
