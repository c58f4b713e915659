// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/occupancy_grid.hpp"
#include "laser_mapper/sensors.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Sessions of a stored map with points.
struct MappedSessions {
  std::vector<std::unique_ptr<urban_nav_core::Trajectory>> trajectories;
  std::vector<laser_mapper::MappedSession> sessions;
  std::vector<std::map<std::uint8_t, urban_nav_core::Pose>> sensors;  ///< extrinsics by their ids
  std::vector<urban_nav_core::Vector3d> path;                         ///< positions of base_link, of all sessions
  std::optional<laser_mapper::Parameters> parameters;
};

/// Returns the sessions of `map` that have points; none if the store holds no map.
MappedSessions mappedSessions(urban_nav_store::Store& store, const std::vector<urban_nav_store::StoredTrajectory>& map);

/// Returns the position of the sensor of a point in the map; nullopt for dense stereo, whose lines of sight do not
/// imply free space.
std::optional<urban_nav_core::Vector3d> beamOrigin(const MappedSessions& mapped, const laser_mapper::MapPoint& point);

}  // namespace urban_nav
