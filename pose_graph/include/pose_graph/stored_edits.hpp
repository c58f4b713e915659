// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/edited_graph.hpp"
#include "urban_nav_store/store.hpp"

namespace pose_graph {

/// Reads the edits of a store that are in force for the sessions `ids`, which the graph calls `names` (one per id).
/// Edits of other sessions are left out. Throws DataError if the store is damaged or an edit has an unknown kind.
std::vector<Edit> readEdits(urban_nav_store::Store& store, const std::vector<SessionId>& ids,
                            const std::vector<std::string>& names);

}  // namespace pose_graph
