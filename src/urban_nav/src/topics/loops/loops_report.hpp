// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "map/context.hpp"
#include "topics/loops/loops_run.hpp"

namespace urban_nav {

/// Returns the section on loop closures: closures on the map by kind and direction of travel (Newman et al. 2009,
/// Fig. 16), keyframes with their matches (Figs. 12, 13), reasons of rejected candidates, and, if it differs, the map
/// without closures by ICP (Figs. 19 and 20).
Section loopsSection(const LoopsRun& run, const MapContext& context);

/// Returns the main findings.
std::vector<Verdict> loopsVerdicts(const LoopsRun& run);

/// Returns the object "loop_metric" of summary.json.
Json toJson(const LoopsRun& run);

}  // namespace urban_nav
