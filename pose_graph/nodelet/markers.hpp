// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "live/live_graph.hpp"

namespace pose_graph {

/// Converts closures to one line list per style, in the colours of Newman et al. 2009, figure 16 (stereo green, ICP
/// purple), and trajectory segments to one line strip each. Earlier markers are deleted.
visualization_msgs::MarkerArray toMarkers(const std::vector<ClosureMarker>& closures,
                                          const std::vector<urban_nav_core::TrajectorySegment>& runs,
                                          urban_nav_core::StampNs stamp, const std::string& map_frame);

}  // namespace pose_graph
