// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "base/command.hpp"
#include "map/stage.hpp"

namespace urban_nav {

/// Returns the stage stereo: dense stereo at keyframes while a session is read. Ground planes and near points go to the
/// store (tables ground_view, near_points), from which the stages graph and lasers take them.
std::unique_ptr<Stage> makeStereoStage();

/// Returns the command disparity: dense stereo of one pair.
Command disparityCommand();

}  // namespace urban_nav
