// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "front_end/corners.hpp"
#include "front_end/match.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// The second half of step (iii): every match is looked for in both images at its place by a pose that is now good to
/// about a pixel, along the row of the sighting where there is one, and refined; sightings that were found stay.
void matchAcross(const Corners& corners, const urban_nav_core::StereoCamera& camera,
                 const urban_nav_core::Pose& T_camera_odom, std::vector<Match>& matches, double row_offset = 0.0);

}  // namespace swf_vo
