// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "camera/lens.hpp"
#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_sim {

/// One imager: how it maps, and where it sits.
struct Camera {
  Lens lens;
  urban_nav_core::Pose T_head_camera;  ///< of its own axes (z along its own lens) in those of the head
  urban_nav_core::CameraInfo info;     ///< as published with its images
};

/// Does the stereo head give what its imagers see, or images without distortion, with rows aligned?
enum class StereoImages { Raw, Rectified };

/// The Bumblebee2 of the New College data set at 512x384 (Smith et al. 2009), left and right; the head's frame is
/// `stereo_left_optical_frame`. The lenses of the raw images are invented, like those of a real head's factory
/// calibration (its factory calibration): corners drawn in to 0.85 of their distance, imagers turned by some tenths of
/// a degree.
std::array<Camera, 2> bumblebee(StereoImages images);

/// The five cameras of the Ladybug2's ring at 384x512, upright, 72 deg apart, number 0 forwards, numbers counting
/// clockwise as seen from above; the head's frame has REP-103's axes (x forward, z up) in the middle of the ring. The
/// lenses are of our making, 83 x 103 deg with barrel distortion: the true ones are not known.
std::array<Camera, 5> ladybug();

}  // namespace urban_nav_sim
