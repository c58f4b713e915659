// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/map_options.hpp"

namespace urban_nav {

/// Returns which closures a run uses, for the user: those of --closures, those of --store, or none. `measured`: their
/// transforms are measured, not read. Throws the errors of urban_nav_store if --store cannot be read.
std::vector<std::string> closureNotes(const MapOptions& options, bool measured);

}  // namespace urban_nav
