// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "urban_nav_core/camera/rectify.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// Right images of a rectified pair whose right camera was turned after the calibration, corrected to the calibrated
/// orientation.
///
/// A turn is a rotation vector w in the axes of the optical frame, R_calibrated_turned = exp(w): to first order it
/// moves the pixel of the direction (x, y, 1) by
///   du = fx (-(1 + x^2) w_y + y w_z + x y w_x),  dv = fy ((1 + y^2) w_x - x w_z - x y w_y).
/// Not thread-safe while the turn changes.
class TurnedRightCamera {
 public:
  explicit TurnedRightCamera(const StereoCamera& camera) : camera_(camera) {}

  /// `turn`: rad; with zero images pass unchanged.
  void set(const Eigen::Vector3d& turn);
  const Eigen::Vector3d& turn() const { return turn_; }

  /// Returns the corrected image, which is a view of `out`, or `right` itself where the turn is zero. An image of
  /// another size than that of the calibration is returned as it is.
  ImageView correct(const ImageView& right, std::vector<std::uint8_t>& out) const;

 private:
  StereoCamera camera_;
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();
  std::optional<RectifyMap> map_;
};

}  // namespace urban_nav_core
