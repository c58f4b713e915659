// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "stages/graph/graph_stage.hpp"

namespace urban_nav {

/// Ids in the graph of those rows of GraphRun::closures that it took.
using OfferedIds = std::map<std::size_t, pose_graph::ClosureId>;

/// Fills run.closures, the known ones first, and offers them to run.graph, whose chains are those of `runs`, in an order that
/// their content alone decides. A row that cannot be used has its reason afterwards; a known one that the file has too has
/// neither id nor reason.
OfferedIds offerClosures(GraphRun& run, const std::vector<const VoRun*>& runs, const std::vector<ClosureRow>& rows,
                         const std::vector<KnownClosure>& known);

}  // namespace urban_nav
