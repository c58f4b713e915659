// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "front_end/corners.hpp"
#include "front_end/match.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// Second half of step (iii): searches each match in the image in which it was not found, with a pose accurate to about
/// a pixel, along the row of the measurement in the other image if there is one, and refines it. Existing measurements
/// are kept.
void matchAcross(const Corners& corners, const urban_nav_core::StereoCamera& camera,
                 const urban_nav_core::Pose& T_camera_odom, std::vector<Match>& matches, double row_offset = 0.0);

}  // namespace swf_vo
