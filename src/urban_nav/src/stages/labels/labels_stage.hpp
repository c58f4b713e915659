// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "stage/stage.hpp"

namespace urban_nav {

/// Returns the stage that labels the points of the lasers' map with classes.
std::unique_ptr<Stage> makeLabelsStage();

}  // namespace urban_nav
