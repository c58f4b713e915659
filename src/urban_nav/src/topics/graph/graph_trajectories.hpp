// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "map/session_trajectory.hpp"
#include "topics/graph/graph_run.hpp"

namespace urban_nav {

/// Replaces the odometry trajectories, one per session of the graph, by those of its maps. A session without steps
/// keeps its single pose of odometry.
std::vector<SessionTrajectory> relaxedTrajectories(const GraphRun& graph, std::vector<SessionTrajectory> odometry);

}  // namespace urban_nav
