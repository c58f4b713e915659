// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_input {

/// Returns the Bumblebee2 of the New College data set for the rectified images of 512x384, from the "Details" page of
/// the data set as quoted by four public readers.
urban_nav_core::StereoCamera newCollegeCamera();

/// Return extrinsics in base_link. Lasers (frames with x along beam 90 deg and z forward): as in public readers of the
/// data set, the height from the ground in their scans. Left camera: unknown; on the mast, as in launch/.
urban_nav_core::Pose newCollegeLeftLaser();
urban_nav_core::Pose newCollegeRightLaser();
urban_nav_core::Pose newCollegeLeftCamera();

}  // namespace urban_nav_input
