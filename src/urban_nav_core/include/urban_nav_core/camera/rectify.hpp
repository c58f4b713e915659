// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/camera/raw_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// Lookup table from rectified to raw pixels.
class RectifyMap {
 public:
  /// R_rectified_raw takes directions of the raw camera to the rectified one. Pixels outside the raw image are filled
  /// with the nearest pixel of its border. Does not throw.
  RectifyMap(const RawCamera& raw, const Eigen::Matrix3d& R_rectified_raw, const Pinhole& rectified);

  const Pinhole& rectified() const { return rectified_; }
  /// Returns the raw pixel of a position in the rectified image, not rounded to the table; empty beyond the fold of the
  /// lens distortion.
  std::optional<Eigen::Vector2d> rawPixel(const Eigen::Vector2d& pixel) const;
  /// Returns the share of the rectified pixels that the raw image covers, 0...1.
  double coveredShare() const { return covered_share_; }
  bool isCovered(int u, int v) const { return covered_[index(u, v)] != 0; }

  /// Remaps an image by bilinear interpolation on a grid of 1/128 px. Returns a view of `out`, or an empty view if
  /// `raw` is empty or not of the raw camera's size. `out` is resized only if its size differs. Thread-safe for
  /// different `out`.
  ImageView remap(const ImageView& raw, std::vector<std::uint8_t>& out) const;

 private:
  struct Entry {
    std::int16_t u, v;    ///< upper left of the four raw pixels
    std::int16_t du, dv;  ///< 0...128: interpolation weight of the next pixel
  };
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(rectified_.width) + static_cast<std::size_t>(u);
  }

  RawCamera raw_;
  Eigen::Matrix3d R_raw_rectified_;
  Pinhole rectified_;
  std::vector<Entry> table_;
  std::vector<std::uint8_t> covered_;
  double covered_share_ = 0.0;
};

/// Rectification of a pair of raw cameras with known relative pose (Bouguet's method): each is rotated by half the
/// rotation between them, then both until the common x axis is the baseline. The rectified pinhole has square pixels,
/// the size of the raw images and the widest field of view that both raw images cover completely.
struct StereoRectification {
  Eigen::Matrix3d R_left = Eigen::Matrix3d::Identity();   ///< R_rectified_raw of the left camera
  Eigen::Matrix3d R_right = Eigen::Matrix3d::Identity();  ///< R_rectified_raw of the right camera
  StereoCamera camera;
};
/// Computes the rectification. T_right_left takes coordinates of the left optical frame to the right one. Throws
/// UserError that begins with `where` if none exists: sizes differ, the right camera is not on the right, or the fields
/// of view do not overlap.
StereoRectification rectifyStereo(const RawCamera& left, const RawCamera& right, const Pose& T_right_left,
                                  const std::string& where);

}  // namespace urban_nav_core
