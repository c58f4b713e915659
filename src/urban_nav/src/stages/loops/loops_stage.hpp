// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "stage/stage.hpp"

namespace urban_nav {

/// Returns the stage loops: measures the transforms of closure candidates (loop_metric). Replaces MapContext::closures
/// by rows with transform or reason.
std::unique_ptr<Stage> makeLoopsStage();

}  // namespace urban_nav
