// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "map/stage.hpp"

namespace urban_nav {

/// Returns the stage that compares independent measurements (urban_nav_trust) and states for each frame and for the map
/// whether the robot was where the map shows, with probabilities. It is the last one of `map`.
std::unique_ptr<Stage> makeTrustStage();

}  // namespace urban_nav
