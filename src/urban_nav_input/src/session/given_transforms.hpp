// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// Adds transforms given by the user, PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW (m; quaternion of length 1 within 5 %), which
/// override all others. One with a leading `?` is that of a driver preset: it is added after the others if the child
/// has no parent, and base_link as a parent is not known. Returns the sentences of those used, for the user. Throws
/// UserError for other text.
std::vector<std::string> giveTransforms(const std::vector<std::string>& given,
                                        urban_nav_ros::StaticTransforms& transforms);

}  // namespace urban_nav_input
