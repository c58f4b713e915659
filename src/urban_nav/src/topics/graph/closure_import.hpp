// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "topics/graph/graph_run.hpp"

namespace urban_nav {

/// Ids in the graph of those rows of GraphRun::closures that it has accepted as input.
using ClosureIds = std::map<std::size_t, pose_graph::ClosureId>;

/// Fills run.closures, previous ones first, and adds them to run.graph, whose chains are those of `runs`, in an order
/// that depends on their content alone. A row that cannot be used gets its reason. A previous closure that a row of the
/// file replaces gets neither id nor reason.
ClosureIds importClosures(GraphRun& run, const std::vector<const SessionOdometry*>& runs,
                          const std::vector<ClosureRow>& rows, const std::vector<PreviousClosure>& previous);

}  // namespace urban_nav
