// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "stage/stage.hpp"

namespace urban_nav {

/// Returns the stage stereo: dense stereo at keyframes while a session is read. Ground planes and near points go to the
/// store (tables ground_view, near_points), from which the stages graph and lasers take them.
std::unique_ptr<Stage> makeStereoStage();

}  // namespace urban_nav
