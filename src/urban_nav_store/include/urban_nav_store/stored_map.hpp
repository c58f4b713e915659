// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// The poses of one session of a store in the frame of its map.
struct StoredTrajectory {
  Session session;
  std::string map;  ///< id of the session at whose first pose the map has its origin
  std::vector<urban_nav_core::StampedPose> T_map_base;
  bool relaxed = false;  ///< else as odometry says
};

/// A node that was not relaxed itself goes with the one before it; without any, `map` is where the session's anchor says,
/// and `odom` where there is none.
StoredTrajectory readTrajectory(Store& store, const Session& session);

/// The sessions of a store whose id or name begins with one of `wanted`, all if that is empty; UserError where none does.
std::vector<Session> sessionsOf(Store& store, const std::vector<std::string>& wanted);

/// Trajectories by map, the maps in the order of their first session.
std::vector<std::vector<StoredTrajectory>> readMaps(Store& store, const std::vector<Session>& sessions);

}  // namespace urban_nav_store
