// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "stage/stage.hpp"

namespace urban_nav {

/// Returns the stage graph: relaxes odometry and closures of all sessions (pose_graph). Replaces
/// MapContext::trajectories by those of the map, MapContext::closures by rows with verdicts, and sets
/// MapContext::relaxed and stereo_only.
std::unique_ptr<Stage> makeGraphStage();

}  // namespace urban_nav
