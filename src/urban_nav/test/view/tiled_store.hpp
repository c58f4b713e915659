// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "laser_mapper/tiles/tile_store.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav::testing {

constexpr double kTiledVoxel = 0.05;  // m
constexpr int kWallPoints = 40;       // for each pose

/// Adds tiles to a store, as `map` does: for each pose a column of points on a wall 4 m to its left. Returns their
/// number.
inline std::size_t addTiles(const std::string& path) {
  urban_nav_store::Store store(path, urban_nav_store::Access::Write);
  std::size_t count = 0;
  for (const auto& map : urban_nav_store::readMaps(store, urban_nav_store::selectSessions(store, {}))) {
    std::vector<laser_mapper::TiledSession> sessions;
    std::map<laser_mapper::Tile, std::vector<laser_mapper::MapPoint>> points;
    for (const urban_nav_store::StoredTrajectory& each : map) {
      sessions.push_back({each.session.id, static_cast<std::uint16_t>(sessions.size()), {}});
      for (const urban_nav_core::StampedPose& pose : each.T_map_base) {
        sessions.back().stamps.push_back(pose.stamp);
        for (int k = 0; k < kWallPoints; ++k) {
          laser_mapper::MapPoint point;
          point.p = (pose.pose * Eigen::Vector3d(0.0, 4.0, 0.1 * k)).cast<float>();
          point.stamp = pose.stamp;
          point.pass = static_cast<std::uint16_t>(sessions.size() - 1);
          point.red = static_cast<std::uint8_t>(80 + 4 * k);
          point.green = 120;
          point.intensity = 90;
          points[laser_mapper::finestTile(laser_mapper::toTilePoint(point, kTiledVoxel))].push_back(point);
          ++count;
        }
      }
    }
    laser_mapper::TileWriter writer(store, sessions, kTiledVoxel);
    for (const auto& [tile, its] : points) writer.add(tile, its);
    writer.finish();
  }
  return count;
}

}  // namespace urban_nav::testing
