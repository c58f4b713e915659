// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "base/command.hpp"
#include "map/stage.hpp"

namespace urban_nav {

/// Returns the stage graph: relaxes odometry and closures of all sessions (pose_graph). Replaces
/// MapContext::trajectories by those of the map, MapContext::closures by rows with verdicts, and sets
/// MapContext::relaxed and stereo_only.
std::unique_ptr<Stage> makeGraphStage();

/// Returns the command relax: pose-graph optimisation of a file.
Command relaxCommand();

}  // namespace urban_nav
