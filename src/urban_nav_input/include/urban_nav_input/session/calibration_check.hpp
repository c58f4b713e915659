// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"

namespace urban_nav_input {

/// What is implausible in a calibration, and what repairs it.
struct CalibrationFault {
  std::string text, remedy;
};

/// Returns what is implausible in a rectified stereo calibration: a baseline in other units than metres, a principal
/// point far from the middle of the image, a field of view that no lens has, pixels that are not square.
std::vector<CalibrationFault> checkCalibration(const urban_nav_core::StereoCamera& camera);

}  // namespace urban_nav_input
