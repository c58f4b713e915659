// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>

#include <string>

#include "urban_nav_core/types/graph_update.hpp"

namespace urban_nav_ros {

/// What of a long run is drawn: its first pose, those at least `spacing` m from the last one drawn, and its last.
urban_nav_core::PoseRun thinned(const urban_nav_core::PoseRun& run, double spacing);

nav_msgs::Path toPathMessage(const urban_nav_core::PoseRun& run, const std::string& map_frame);

}  // namespace urban_nav_ros
