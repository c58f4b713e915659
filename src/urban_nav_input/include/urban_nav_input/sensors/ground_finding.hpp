// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_input/examination/finding.hpp"
#include "urban_nav_input/sensors/sight.hpp"

namespace urban_nav_input {

/// Compares three estimates of the vertical: by the ground plane of stereo (with the pose of the camera), by the
/// accelerometer (with the pose of the IMU), and the z axis of base_link. Returns a finding on the device whose pose
/// contradicts the other two by more than slopes explain. `grounds`: few or scattered ones give no finding. `force`:
/// mean specific force in the axes of base_link, of any length.
std::vector<Finding> groundFindings(const std::string& imu, const std::vector<SeenGround>& grounds,
                                    const urban_nav_core::Vector3d& force);

}  // namespace urban_nav_input
