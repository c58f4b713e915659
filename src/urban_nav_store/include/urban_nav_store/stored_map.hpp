// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// Poses of one session of a store in the frame of its map.
struct StoredTrajectory {
  Session session;
  std::string map;  ///< id of the session whose first pose is the origin of the map
  std::vector<urban_nav_core::StampedPose> T_map_base;
  bool relaxed = false;  ///< false: odometry only
};

/// Returns the trajectory of a session in its map. A node without an optimised pose moves rigidly with the previous
/// node that has one; if there is none, the anchor of the session relates `map` to `odom`, which coincide without an
/// anchor.
StoredTrajectory readTrajectory(Store& store, const Session& session);

/// Returns the sessions whose id or name begins with one of `wanted`, or all if it is empty. Throws UserError for an
/// entry without a session.
std::vector<Session> selectSessions(Store& store, const std::vector<std::string>& wanted);

/// Returns trajectories grouped by map, in the order of each map's first session.
std::vector<std::vector<StoredTrajectory>> readMaps(Store& store, const std::vector<Session>& sessions);

}  // namespace urban_nav_store
