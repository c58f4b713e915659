// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "stage/stage.hpp"

namespace urban_nav {

/// Returns the stage vo: visual odometry by the sliding window filter (swf_vo). Always enabled, and first: it sets the
/// odometry row of each item, MapSession::vo, and the trajectories of odometry.
std::unique_ptr<Stage> makeVoStage();

}  // namespace urban_nav
