// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "front_end/corners.hpp"
#include "front_end/match.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// Pixel of a homogeneous point of `odom` in one image; empty if it is not in front of the camera. Not limited to the
/// image. `row_offset` (RowOffset) is by what the right one shows it lower, here and below.
std::optional<Eigen::Vector2d> projectInto(Side side, const urban_nav_core::StereoCamera& camera,
                                           const urban_nav_core::Pose& T_camera_odom, const Eigen::Vector4d& p_odom,
                                           double row_offset = 0.0);

/// Step (iii) of section 2.4: landmarks projected in turn into the left and the right image, compared with the FAST
/// corners of their level within `radius` px (of level 0) by mean-removed SAD, the best one refined. Where no corner is
/// accepted the template is aligned at the projection itself. Fills `left` or `right` of each match.
void matchTemporal(const Corners& corners, const urban_nav_core::StereoCamera& camera,
                   const urban_nav_core::Pose& T_camera_odom, double radius, std::vector<Match>& matches,
                   double row_offset = 0.0);

/// The same where the motion of the camera is unknown: so far around that much looks alike, hence corners alone, and
/// only one that is clearly better than all others.
void matchAnywhere(const Corners& corners, const urban_nav_core::StereoCamera& camera,
                   const urban_nav_core::Pose& T_camera_odom, double radius, std::vector<Match>& matches,
                   double row_offset = 0.0);

}  // namespace swf_vo
