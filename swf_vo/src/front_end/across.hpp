// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "front_end/corners.hpp"
#include "front_end/match.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// The second half of step (iii): every match is looked for in both images at its place by a pose that is now good to about a
/// pixel, along the row of the sighting where there is one, and refined; sightings that were found stay.
void matchAcross(const Corners& corners, const urban_nav_core::StereoCamera& camera,
                 const urban_nav_core::Pose& T_camera_odom, std::vector<Match>& matches, double row_offset = 0.0);

/// Left-right matching of a corner seen for the first time (step v): the row of the other image is searched from `lowest` to
/// `highest` disparity (px of the level), the best must be better than anything a few pixels away, and the search back from there must
/// lead to the corner. `row_offset` (px of the level): the row in the right image is so much further down. Returns the whole-pixel disparity.
std::optional<int> findDisparity(const urban_nav_core::ImageView& left, const urban_nav_core::ImageView& right, int u,
                                 int v, int lowest, int highest, int row_offset = 0);

}  // namespace swf_vo
