// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_store/store.hpp"

namespace pose_graph {

/// Returns the ground normals of a session in a store, in order of time; views without a plane are left out.
std::vector<GroundNormal> readGround(urban_nav_store::Store& store, const SessionId& session);

/// Writes ground normals as views of a session.
void writeGround(urban_nav_store::Store& store, const SessionId& session, const std::vector<GroundNormal>& normals);

}  // namespace pose_graph
