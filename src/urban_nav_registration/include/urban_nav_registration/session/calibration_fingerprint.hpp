// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_registration/keyframe/mounted_camera.hpp"

namespace urban_nav_registration {

/// Returns a text that identifies a camera and its pose on the robot, with all numbers. Keyframes of two sessions with
/// the same fingerprint can be matched directly; others require a KeyframeConversion.
std::string calibrationFingerprint(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_base_left);
/// Returns the camera of a fingerprint; nullopt if the text is not a fingerprint.
std::optional<MountedCamera> parseCalibrationFingerprint(const std::string& words);
/// Returns true if two fingerprints agree to a millionth of a pixel, metre or radian: robot descriptions and bags are
/// rounded differently.
bool isSameCalibration(const std::string& words, const std::string& others);
/// Name of the session property that holds the fingerprint in a store.
constexpr const char* kCalibrationProperty = "camera";

}  // namespace urban_nav_registration
