// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "stages/graph/graph_stage.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Puts what relaxation made into a store: a pose in `map` for every node, each closure that the graph took as an edge with its verdict, and
/// an anchor for each session. `ids`: the store's names of graph.sessions. Closures and poses of an earlier relaxation of
/// these sessions give way; `revision`: the highest of theirs. Beside each closure stands, as its evidence, the row of
/// closures.csv that it was offered as. Not committed.
void putGraph(urban_nav_store::Store& store, const std::vector<urban_nav_store::SessionId>& ids, const GraphRun& run,
              std::int64_t revision = 0);

}  // namespace urban_nav
