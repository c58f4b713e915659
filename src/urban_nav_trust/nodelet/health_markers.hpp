// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include "live/stage_health.hpp"

namespace urban_nav_trust {

/// Returns the health of all nodes as a text above base_link for rviz: green, yellow with warnings, red with errors.
visualization_msgs::MarkerArray toMarkers(const StageHealth::Text& text);

}  // namespace urban_nav_trust
