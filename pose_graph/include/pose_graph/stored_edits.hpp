// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/edited_graph.hpp"
#include "urban_nav_store/store.hpp"

namespace pose_graph {

/// Returns the edits of a store that are in force, for a graph that calls the sessions `ids` by these names; those that
/// concern other sessions are left out. `names`: one per id. Throws DataError if the store is damaged or an edit is of
/// an unknown kind.
std::vector<Edit> readEdits(urban_nav_store::Store& store, const std::vector<SessionId>& ids,
                            const std::vector<std::string>& names);

}  // namespace pose_graph
