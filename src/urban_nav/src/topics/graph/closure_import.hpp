// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "topics/graph/graph_run.hpp"

namespace urban_nav {

/// Fills run.closures, previous ones first, and adds them to run.graph, whose chains are those of `runs`, in an order
/// that depends only on their content. Sets in run.assessments the id of each closure in the graph, or the reason why
/// it cannot be used; neither for a previous closure that a new one replaces. Then adds the closures of edits, and
/// those rejected by edits to run.rejected_by_hand.
void importClosures(GraphRun& run, pose_graph::EditedGraph& edited, const std::vector<const SessionOdometry*>& runs,
                    const std::vector<urban_nav_core::MetricClosure>& closures, const PreviousClosures& previous);

}  // namespace urban_nav
