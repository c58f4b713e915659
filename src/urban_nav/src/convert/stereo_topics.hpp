// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "convert/bag_writer.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace urban_nav {

/// Writes a rectified pair with its camera_info on the topics of docs/architecture.md; omits an empty view and its
/// camera_info.
void writeStereo(const urban_nav_core::StereoPair& pair, urban_nav_core::StampNs stamp,
                 const urban_nav_core::StereoCamera& camera, BagWriter& bag);

/// Returns the transforms from base_link to both optical frames.
std::vector<geometry_msgs::TransformStamped> stereoTransforms(const urban_nav_core::StereoCamera& camera,
                                                              const urban_nav_core::Pose& T_base_left);

}  // namespace urban_nav
