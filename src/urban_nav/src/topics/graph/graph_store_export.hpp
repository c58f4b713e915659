// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "topics/graph/graph_run.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Updates the closures and poses of a store by a relaxation: verdicts, poses in `map` with their covariances, an
/// anchor for each session, graph.g2o, and the closures of edits, replacing earlier ones. Other closures are kept.
/// `ids`: store keys of run.sessions; `revision`: the highest of their poses. Does not commit.
void storeRelaxation(urban_nav_store::Store& store, const std::vector<urban_nav_store::SessionId>& ids,
                     const GraphRun& run, std::int64_t revision);

/// Writes the result of a relaxation to a store: a pose in `map` with its covariance for every node, each closure of
/// the graph as an edge with its verdict, an anchor for each session, and graph.g2o. `ids`: store keys of
/// run.sessions. Replaces closures and poses of an earlier relaxation of these sessions, whose highest revision is
/// `revision`. The evidence of a closure is its row of closures.csv. Does not commit.
void exportGraph(urban_nav_store::Store& store, const std::vector<urban_nav_store::SessionId>& ids, const GraphRun& run,
                 std::int64_t revision = 0);

/// Returns the permanent number in the store of each of run.closures, its ID in `edge` and `why`; 0 for a closure that
/// the store does not hold. `ids`: store keys of run.sessions. Call after exportGraph().
std::vector<std::int64_t> readClosureNumbers(urban_nav_store::Store& store,
                                             const std::vector<urban_nav_store::SessionId>& ids, const GraphRun& run);

}  // namespace urban_nav
