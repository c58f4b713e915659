// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "live/belief_trail.hpp"

namespace fabmap_node {

/// Returns markers of the beliefs along the path, coloured by knowledge (KNOWN green, UNSURE orange, NEW blue). The
/// last one also has a text, and for a place of this session a line to it and a sphere whose diameter grows with its
/// probability. Earlier markers are deleted. Requires a point.
visualization_msgs::MarkerArray toMarkers(const BeliefTrail& trail, const std::string& odom_frame);

}  // namespace fabmap_node
