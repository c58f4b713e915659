// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_sim {

/// Where the sensors are on base_link, by the names of their frames (docs/conventions.md): the paper's robot, as
/// launch/urdf/lisa.urdf describes it. The lasers' places are those of the New College set, the others plausible.
std::map<std::string, urban_nav_core::Pose> sensorPlaces();
urban_nav_core::Pose sensorPose(const std::string& frame);
/// T_base_lidar of the 3D LiDAR, which only robots that ask for it carry: above the Ladybug, x forward, z up.
urban_nav_core::Pose lidarPose();
/// T_base_head of the Ladybug: x forward, z up, in the middle of its ring of lenses.
urban_nav_core::Pose ladybugPlace();

}  // namespace urban_nav_sim
