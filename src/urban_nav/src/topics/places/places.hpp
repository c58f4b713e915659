// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "base/command.hpp"
#include "map/stage.hpp"

namespace urban_nav {

/// Returns the stage places: recognises places in panoramas, or in left images without them (fabmap_node), and appends
/// the proposed closures to MapContext::closures if a stage measures them.
std::unique_ptr<Stage> makePlacesStage();

/// Returns the command places with its actions.
Command placesCommand();

}  // namespace urban_nav
