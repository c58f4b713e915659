// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "camera/lens.hpp"
#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_sim {

/// One imager: projection and extrinsics.
struct Camera {
  Lens lens;
  urban_nav_core::Pose T_head_camera;  ///< camera axes (z along its lens) in those of the head
  urban_nav_core::CameraInfo info;     ///< as published with its images
};

/// Raw images, or images without distortion and with aligned rows.
enum class StereoImages { Raw, Rectified };

/// Returns the Bumblebee2 of the New College data set at 512x384 (Smith et al. 2009), left and right; the frame of the
/// head is `stereo_left_optical_frame`. The lenses of the raw images are invented, similar to a factory calibration of
/// a real head: corners contracted to 0.85 of their distance, imagers rotated by some tenths of a degree.
std::array<Camera, 2> bumblebee(StereoImages images);

/// Returns the five cameras of the ring of the Ladybug2 at 384x512, upright, 72 deg apart, number 0 forward, counted
/// clockwise as seen from above; the frame of the head has REP-103 axes (x forward, z up) at the centre of the ring.
/// The lenses are assumed, 83 x 103 deg with barrel distortion, since the true ones are unknown.
std::array<Camera, 5> ladybug();

}  // namespace urban_nav_sim
