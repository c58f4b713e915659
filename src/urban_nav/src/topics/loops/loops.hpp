// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "base/command.hpp"
#include "map/stage.hpp"

namespace urban_nav {

/// Returns the stage keyframes: stores keyframes of each session while it is read, for loops and localization of this
/// or a later run.
std::unique_ptr<Stage> makeKeyframesStage();

/// Returns the stage loops: measures the transforms of closure candidates (loop_metric). Replaces MapContext::closures
/// by closures with transform or reason.
std::unique_ptr<Stage> makeLoopsStage();

/// Returns the command icp: aligns two clouds.
Command icpCommand();

}  // namespace urban_nav
