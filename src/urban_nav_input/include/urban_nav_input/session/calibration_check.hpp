// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Returns implausible values of a rectified stereo calibration: a baseline in other units than metres, a principal
/// point far from the image centre, an impossible field of view, pixels that are not square. `baseline_scale`: factor
/// already applied to the baseline (input.baseline_scale). The options scale the baseline, unless two units are about
/// as likely.
std::vector<Finding> checkCalibration(const urban_nav_core::StereoCamera& camera, double baseline_scale = 1.0);

}  // namespace urban_nav_input
