// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_input {

/// The Bumblebee2 of the New College data set: the data set's "Details" page, as four readers quote it, for the
/// rectified images of 512x384.
urban_nav_core::StereoCamera newCollegeCamera();

/// Where things are on base_link. The lasers (frames with x along beam 90 deg and z forward): as the data set's readers
/// have them, the height from the ground that they see. The left camera: not known; on the mast, as launch/ has it.
urban_nav_core::Pose newCollegeLeftLaser();
urban_nav_core::Pose newCollegeRightLaser();
urban_nav_core::Pose newCollegeLeftCamera();

}  // namespace urban_nav_input
