// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// Adds transforms given by the user, PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW (m; quaternion of length 1 within 5 %), which
/// override all others. Throws UserError for other text.
void giveTransforms(const std::vector<std::string>& given, urban_nav_ros::StaticTransforms& transforms);

}  // namespace urban_nav_input
