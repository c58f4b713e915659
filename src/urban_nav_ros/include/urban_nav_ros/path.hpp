// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>

#include <cstddef>
#include <string>

#include "urban_nav_core/types/graph_update.hpp"

namespace urban_nav_ros {

/// Returns a segment for display: its first pose, poses at least `spacing` m from the previous one kept, and its last.
urban_nav_core::TrajectorySegment thinned(const urban_nav_core::TrajectorySegment& run, double spacing);

nav_msgs::Path toPathMessage(const urban_nav_core::TrajectorySegment& run, const std::string& map_frame);

/// Appends a pose to a path for display. Returns false, without effect, for a pose closer than `spacing` (m) to the
/// last one. At `max_points` the oldest tenth is removed.
bool appendToPath(urban_nav_core::StampNs stamp, const urban_nav_core::Pose& pose, double spacing,
                  std::size_t max_points, nav_msgs::Path& path);

}  // namespace urban_nav_ros
