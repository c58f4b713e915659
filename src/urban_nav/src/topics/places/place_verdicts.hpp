// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fabmap_node/parameters.hpp"
#include "map/context.hpp"
#include "topics/places/places_run.hpp"

namespace urban_nav {

/// Returns a run whose beliefs include the verdicts on the closures of the context: those of stage loops, and later
/// rejections by stage graph. Closures from files are not verdicts, unless stage loops measured them.
PlacesRun withVerdicts(PlacesRun run, const fabmap_node::Parameters& parameters, const MapContext& context);

}  // namespace urban_nav
