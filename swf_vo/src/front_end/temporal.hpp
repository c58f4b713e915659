// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "front_end/corners.hpp"
#include "front_end/match.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// Returns the pixel of a homogeneous point of `odom` in one image, which may be outside the image; empty if the point
/// is not in front of the camera. `row_offset` (RowOffset): vertical offset of the right image, also below.
std::optional<Eigen::Vector2d> projectInto(Side side, const urban_nav_core::StereoCamera& camera,
                                           const urban_nav_core::Pose& T_camera_odom, const Eigen::Vector4d& p_odom,
                                           double row_offset = 0.0);

/// Step (iii) of section 2.4: projects landmarks into the left and the right image, compares the template with FAST
/// corners of its level within `radius` px (of level 0) by mean-removed SAD, and refines the best one. If no corner is
/// accepted, the template is aligned at the projection. Sets `left` or `right` of each match.
void matchTemporal(const Corners& corners, const urban_nav_core::StereoCamera& camera,
                   const urban_nav_core::Pose& T_camera_odom, double radius, std::vector<Match>& matches,
                   double row_offset = 0.0);

/// Variant for unknown camera motion: the radius is so large that many patches are similar, hence only corners are
/// compared, and the best one must be clearly better than all others.
void matchAnywhere(const Corners& corners, const urban_nav_core::StereoCamera& camera,
                   const urban_nav_core::Pose& T_camera_odom, double radius, std::vector<Match>& matches,
                   double row_offset = 0.0);

}  // namespace swf_vo
