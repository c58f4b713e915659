// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/camera/raw_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// Where each pixel of a rectified image lies in the raw one.
class RectifyMap {
 public:
  /// R_rectified_raw takes directions of the raw camera to the rectified one. Throws nothing; pixels that the raw
  /// camera does not see are filled with the nearest border of the raw image.
  RectifyMap(const RawCamera& raw, const Eigen::Matrix3d& R_rectified_raw, const Pinhole& rectified);

  const Pinhole& rectified() const { return rectified_; }
  /// Raw pixel that is seen at a place of the rectified image (not rounded to the table); empty if the lens does not
  /// reach there.
  std::optional<Eigen::Vector2d> rawPixel(const Eigen::Vector2d& pixel) const;
  /// Share of the rectified pixels that the raw image covers, 0...1.
  double coveredShare() const { return covered_share_; }
  bool isCovered(int u, int v) const { return covered_[index(u, v)] != 0; }

  /// Bilinear interpolation on a grid of 1/128 px. `raw` has the raw camera's size, else (or if it is empty) the
  /// result is an empty view. `out` is resized only if it has another size; the view looks into it. Thread-safe for
  /// different `out`.
  ImageView remap(const ImageView& raw, std::vector<std::uint8_t>& out) const;

 private:
  struct Entry {
    std::int16_t u, v;    ///< of the upper left of four raw pixels
    std::int16_t du, dv;  ///< 0...128: how far towards the next
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

/// How to rectify a pair of raw cameras whose relative pose is known: both are turned by half the rotation between
/// them, then together until their common x axis is the baseline (Bouguet's method). The rectified pinhole has square
/// pixels and the size of the raw images, and is the one with the widest view that both raw images cover entirely.
struct StereoRectification {
  Eigen::Matrix3d R_left = Eigen::Matrix3d::Identity();   ///< R_rectified_raw of the left camera
  Eigen::Matrix3d R_right = Eigen::Matrix3d::Identity();  ///< and of the right one
  StereoCamera camera;
};
/// T_right_left takes coordinates of the left optical frame to the right one. Throws UserError that begins with
/// `where` if there is no such rectification: sizes differ, the right camera is not on the right, or the two look
/// apart.
StereoRectification rectifyStereo(const RawCamera& left, const RawCamera& right, const Pose& T_right_left,
                                  const std::string& where);

}  // namespace urban_nav_core
