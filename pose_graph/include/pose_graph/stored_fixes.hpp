// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/fix_use.hpp"
#include "urban_nav_store/store.hpp"

namespace pose_graph {

/// Returns the fixes that a store has of a session, in order of time.
std::vector<PositionFix> readFixes(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// Writes fixes of a session; one with the stamp of another takes its place.
void writeFixes(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                const std::vector<PositionFix>& fixes);

}  // namespace pose_graph
