// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "segway_drivers/camera/sim_source.hpp"
#include "urban_nav_core/camera/camera_info.hpp"

namespace segway_drivers {

/// Reads frames of a simulated Bumblebee2 from the stereo images of a bag, image_raw or image_rect. Throws UserError if
/// the bag cannot be read or has none.
FrameReader readStereoFrames(const std::string& bag);
/// Reads frames of a simulated Ladybug2 from the images of its five cameras in a bag. Throws UserError as above.
FrameReader readLadybugFrames(const std::string& bag);

/// Returns the calibration of one side of the stereo camera in a bag, scaled to the size of the imager; empty if the
/// bag has none.
std::optional<urban_nav_core::CameraInfo> readStereoInfo(const std::string& bag, const std::string& side);

}  // namespace segway_drivers
