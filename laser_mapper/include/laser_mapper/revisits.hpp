// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper {

/// Returns, for each trajectory, the beginnings of the chunks during which the robot came within `reach` (m) of its
/// path in another pass (passes.hpp). Trajectories are in one map frame. Thread-safe.
std::vector<std::set<urban_nav_core::StampNs>> findRevisitedChunks(
    const std::vector<const urban_nav_core::Trajectory*>& T_map_base, double reach);

}  // namespace laser_mapper
