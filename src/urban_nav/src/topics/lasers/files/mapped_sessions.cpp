// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/files/mapped_sessions.hpp"

namespace urban_nav {

using laser_mapper::MapPoint;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {}  // namespace

MappedSessions mappedSessions(Store& store, const std::vector<StoredTrajectory>& map) {
  MappedSessions result;
  for (const StoredTrajectory& each : map) {
    const auto parameters = laser_mapper::storedMapParameters(store, each.session.id);
    if (!parameters || each.T_map_base.empty()) continue;
    result.parameters = parameters;
    result.trajectories.push_back(std::make_unique<Trajectory>(each.T_map_base));
    result.sessions.push_back({each.session.id, result.trajectories.back().get(), nullptr});
    result.sensors.push_back(laser_mapper::sensorPlaces(store, each.session.id));
    for (const urban_nav_core::StampedPose& pose : each.T_map_base) result.path.push_back(pose.pose.t());
  }
  return result;
}

std::optional<Vector3d> beamOrigin(const MappedSessions& mapped, const MapPoint& point) {
  for (std::size_t s = 0; s < mapped.sessions.size(); ++s)
    if (const auto origin = laser_mapper::beamOrigin(point, *mapped.trajectories[s], mapped.sensors[s])) return origin;
  return std::nullopt;
}

}  // namespace urban_nav
