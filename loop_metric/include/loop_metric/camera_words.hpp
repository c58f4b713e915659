// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace loop_metric {

/// What tells the camera of a session, with its place on the robot, from another: two sessions with equal words can be matched view by view.
std::string cameraWords(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_base_left);
/// Do these words tell of one camera at one place, to a millionth of a pixel, metre or radian? A robot description and a bag round differently.
bool areOfOneCamera(const std::string& words, const std::string& others);
/// The property of a session in a store that holds them.
constexpr const char* camera_property = "camera";

}  // namespace loop_metric
