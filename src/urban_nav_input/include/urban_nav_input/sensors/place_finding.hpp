// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Returns a finding for a sensor farther from base_link than the size of a robot: its pose is not in metres. The
/// option sets the pose in metres, unless two units are about as likely.
std::vector<Finding> placeFindings(const std::string& frame, const urban_nav_core::Pose& T_base_sensor);

/// Returns the option that sets the pose of a sensor.
std::vector<std::string> placeOptions(const std::string& frame, const urban_nav_core::Pose& T_base_sensor);

}  // namespace urban_nav_input
