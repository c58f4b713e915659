// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Returns what is implausible in a rectified stereo calibration: a baseline in other units than metres, a principal
/// point far from the middle of the image, a field of view that no lens has, pixels that are not square.
/// `baseline_scale`: by which the baseline has been multiplied already (input.baseline_scale). The options of a
/// baseline scale it, unless two units are about as likely.
std::vector<Finding> checkCalibration(const urban_nav_core::StereoCamera& camera, double baseline_scale = 1.0);

}  // namespace urban_nav_input
