// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/closures_file.hpp"
#include "pose_graph/pose_graph.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// A closure between stored sessions that an earlier run has added to the graph.
struct PreviousClosure {
  ClosureRow row;
  pose_graph::Closure closure;  ///< sessions by their names
};

/// Returns the closures that the store holds between these sessions, asserted ones included. `names`: one per id.
std::vector<PreviousClosure> closuresBetween(urban_nav_store::Store& store,
                                             const std::vector<urban_nav_store::SessionId>& ids,
                                             const std::vector<std::string>& names);

}  // namespace urban_nav
