// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <optional>

#include "urban_nav_core/camera/distortion.hpp"
#include "urban_nav_core/camera/pinhole.hpp"

namespace urban_nav_core {

/// A camera as it left the factory: a pinhole with a lens.
struct RawCamera {
  Pinhole pinhole;
  Distortion distortion;

  /// Pixel of a point in the optical frame, inside the image or not; empty behind the camera and beyond the fold.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_cam) const;
  /// The direction, with z = 1, that a pixel sees; empty where the lens model folds.
  std::optional<Eigen::Vector3d> ray(const Eigen::Vector2d& pixel) const;
};

std::ostream& operator<<(std::ostream& out, const RawCamera& camera);

}  // namespace urban_nav_core
