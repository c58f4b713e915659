// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "command_line/json.hpp"
#include "report/page.hpp"
#include "stages/graph/graph_stage.hpp"
#include "stages/loops/loops_stage.hpp"

namespace urban_nav {

/// What the stage loops found: closures on the map by kind and direction of travel (Newman et al. 2009, Fig. 16), views with their matches (Figs. 12, 13),
/// why candidates were rejected. `graph`: none where it did not run; `without_icp`: the same without closures by ICP (Figs. 19 and 20), where that
/// is another one.
Section loopsSection(const LoopsRun& run, const std::vector<const VoRun*>& runs,
                     const std::vector<std::string>& sessions, const GraphRun* graph, const GraphRun* without_icp);

/// What it says in plain words.
std::vector<Verdict> loopsVerdicts(const LoopsRun& run);

/// The object "loop_metric" of summary.json.
Json toJson(const LoopsRun& run);

}  // namespace urban_nav
