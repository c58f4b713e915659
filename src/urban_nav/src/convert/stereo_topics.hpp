// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "convert/bag_writer.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace urban_nav {

/// A rectified pair with its camera_info on the topics of docs/architecture.md; an empty view is left out, with its
/// camera_info.
void writeStereo(const urban_nav_core::StereoPair& pair, urban_nav_core::StampNs stamp,
                 const urban_nav_core::StereoCamera& camera, BagWriter& bag);

/// Where the two optical frames are on base_link.
std::vector<geometry_msgs::TransformStamped> stereoTransforms(const urban_nav_core::StereoCamera& camera,
                                                              const urban_nav_core::Pose& T_base_left);

}  // namespace urban_nav
