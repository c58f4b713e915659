// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "map/stage.hpp"

namespace urban_nav {

/// Returns the stage that compares independent measurements (urban_nav_trust) and estimates, for each frame and for the
/// map, the probability that positions are correct. It is the last stage of `map`.
std::unique_ptr<Stage> makeTrustStage();

}  // namespace urban_nav
