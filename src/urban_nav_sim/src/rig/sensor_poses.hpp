// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_sim {

/// Returns the poses of the sensors on base_link by the names of their frames (docs/conventions.md): the robot of the
/// paper, as in launch/urdf/lisa.urdf. The poses of the lasers are those of the New College set, the others plausible.
std::map<std::string, urban_nav_core::Pose> sensorPlaces();
urban_nav_core::Pose sensorPose(const std::string& frame);
/// Returns T_base_lidar of the optional 3D LiDAR: above the Ladybug, x forward, z up.
urban_nav_core::Pose lidarPose();
/// Returns T_base_head of the Ladybug: x forward, z up, at the centre of its ring of lenses.
urban_nav_core::Pose ladybugPlace();

}  // namespace urban_nav_sim
