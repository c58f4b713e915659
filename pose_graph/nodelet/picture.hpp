// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "live_graph.hpp"

namespace pose_graph {

/// One line list for each look, in the colours of Newman et al. 2009, figure 16, where it has them: stereo green, ICP
/// purple; and a line strip for each run. What of an earlier picture is not in this one is deleted.
visualization_msgs::MarkerArray toMarkers(const std::vector<Tie>& ties,
                                          const std::vector<urban_nav_core::PoseRun>& runs,
                                          urban_nav_core::StampNs stamp, const std::string& map_frame);

}  // namespace pose_graph
