// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "map/stage.hpp"

namespace urban_nav {

/// Returns the stage localization, enabled by --localise: localises each session in the map of a store, which is only
/// read. Sets SessionTrajectory::localized.
std::unique_ptr<Stage> makeLocalizationStage();

}  // namespace urban_nav
