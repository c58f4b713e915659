// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_input/examination/finding.hpp"
#include "urban_nav_input/sensors/sight.hpp"

namespace urban_nav_input {

/// Compares three directions that should be one: up by the ground that stereo sees (by the place of the camera), up by
/// the accelerometer (by the place of the IMU), and the z axis of base_link. Names the device whose place contradicts
/// the other two by more than slopes explain. `grounds`: few or scattered ones give nothing. `force`: mean specific
/// force in the same axes, of any length.
std::vector<Finding> groundFindings(const std::string& imu, const std::vector<SeenGround>& grounds,
                                    const urban_nav_core::Vector3d& force);

}  // namespace urban_nav_input
