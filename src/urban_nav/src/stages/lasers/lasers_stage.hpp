// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "stage/stage.hpp"

namespace urban_nav {

/// Returns the stage that renders the laser scans of all sessions along their trajectories into map.ply.
std::unique_ptr<Stage> makeLasersStage();

}  // namespace urban_nav
