// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "stage/stage.hpp"

namespace urban_nav {

/// Returns the stage keyframes: stores keyframes of each session while it is read, for loops and localization of this
/// or a later run.
std::unique_ptr<Stage> makeKeyframesStage();

}  // namespace urban_nav
