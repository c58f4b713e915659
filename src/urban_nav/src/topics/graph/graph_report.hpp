// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "map/context.hpp"
#include "topics/graph/graph_run.hpp"

namespace urban_nav {

/// Returns the section on relaxation: paths before and after with the closures between them, every closure with its
/// verdict, cost over iterations, and errors against ground truth. `evaluations`: one per session, or empty.
Section graphSection(const GraphRun& graph, const std::vector<const SessionOdometry*>& runs,
                     const std::vector<SessionEvaluations>& evaluations);

/// Returns the main findings.
std::vector<Verdict> graphVerdicts(const GraphRun& graph);

/// Returns the object "pose_graph" of summary.json. `evaluations`: one per session, or empty.
Json toJson(const GraphRun& graph, const std::vector<SessionEvaluations>& evaluations);

}  // namespace urban_nav
