// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/session_odometry.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_trust/depth_comparison.hpp"

namespace urban_nav {

/// Returns stereo points of some keyframes of a session near laser surfaces measured within 6 m of travel, placed along
/// odometry: points of dense stereo, and corners of the loop closure keyframes, the only points that reach the walls
/// along the path. Empty without points or scans. Throws DataError if the store is damaged.
std::vector<urban_nav_trust::KeyframeMatches> matchDepths(urban_nav_store::Store& store,
                                                          const urban_nav_store::SessionId& session,
                                                          const SessionOdometry& odometry);

/// Returns the names of the lasers of a session, by number as in these matches.
std::vector<std::string> comparedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace urban_nav
