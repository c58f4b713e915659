// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/io/calibration.hpp"

namespace urban_nav_input {

/// Returns the left and right camera of --calibration: calib.txt of KITTI (for images of `width` x `height`; `pair`:
/// cameras to read), a file with both cameras or one for each (parseStereoCalibration()). Throws UserError for other
/// files.
std::pair<urban_nav_core::CameraInfo, urban_nav_core::CameraInfo> readCalibration(
    const std::string& files, int width, int height, urban_nav_core::KittiPair pair = urban_nav_core::KittiPair::Grey);

/// Multiply the baseline by a scale. The second throws UserError, with `where`, unless the result is positive.
void scaleBaseline(double scale, urban_nav_core::CameraInfo& left, urban_nav_core::CameraInfo& right);
void scaleBaseline(double scale, const std::string& where, urban_nav_core::StereoCamera& camera);

}  // namespace urban_nav_input
