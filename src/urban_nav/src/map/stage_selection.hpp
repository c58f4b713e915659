// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "map/stage_list.hpp"

namespace urban_nav {

/// Returns the stages of a run with these options, in order, and prints them with their notes and the reasons of
/// disabled ones. Throws UserError for unknown words of --stages and for contradicting options.
StageList selectStages(const std::vector<std::unique_ptr<Stage>>& stages, const MapOptions& options, Console& console);

}  // namespace urban_nav
