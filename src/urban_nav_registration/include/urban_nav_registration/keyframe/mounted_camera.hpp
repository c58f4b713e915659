// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_registration {

/// Stereo camera and the pose of its left side on the robot.
struct MountedCamera {
  urban_nav_core::StereoCamera camera;
  urban_nav_core::Pose T_base_left;
};

}  // namespace urban_nav_registration
