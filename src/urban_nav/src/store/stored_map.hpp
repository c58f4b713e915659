// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// The poses of one session of a store in the frame of its map.
struct StoredTrajectory {
  urban_nav_store::Session session;
  std::string map;  ///< id of the session at whose first pose the map has its origin
  std::vector<urban_nav_core::StampedPose> T_map_base;
  bool relaxed = false;  ///< else as odometry says
};

/// A node that was not relaxed itself goes with the one before it; without any, `map` is where the session's anchor says,
/// and `odom` where there is none.
StoredTrajectory readTrajectory(urban_nav_store::Store& store, const urban_nav_store::Session& session);

/// The sessions of a store whose id or name begins with one of `wanted`, all if that is empty; UserError where none does.
std::vector<urban_nav_store::Session> sessionsOf(urban_nav_store::Store& store, const std::vector<std::string>& wanted);

/// Trajectories by map, the maps in the order of their first session.
std::vector<std::vector<StoredTrajectory>> readMaps(urban_nav_store::Store& store,
                                                    const std::vector<urban_nav_store::Session>& sessions);

}  // namespace urban_nav
