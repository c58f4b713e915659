// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/result_recorder.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Writes each map of a store as MCAP: poses, transforms, closures, places and points, each at its stamp, and at the
/// last pose diagnostics with the figures of the stages, or else with the health of the odometry. The first map goes to
/// `path`, separate maps to PATH_2 and so on. Returns the files. `memory_mb`: limit of the command. Throws DataError
/// without poses.
std::vector<std::string> recordResults(urban_nav_store::Store& store,
                                       const std::vector<std::vector<urban_nav_store::StoredTrajectory>>& maps,
                                       const std::string& path, double memory_mb,
                                       const std::vector<StageFigures>& figures);

/// Calls recordResults() for all sessions of a store (a ResultRecorder).
std::vector<std::string> recordAllResults(urban_nav_store::Store& store, const std::string& path, double memory_mb,
                                          const std::vector<StageFigures>& figures);

}  // namespace urban_nav
