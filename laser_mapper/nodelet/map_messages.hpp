// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urban_nav_msgs/MapQuality.h>
#include <urban_nav_msgs/MapTile.h>

#include <string>

#include "laser_mapper/quality/map_quality.hpp"
#include "live/live_map.hpp"

namespace laser_mapper {

/// Return messages in the frame `frame`, stamped with the newest pose. `voxel`: edge of the map's cubes, m.
urban_nav_msgs::MapTile toMapTileMessage(const LiveMap::ChangedTile& tile, double voxel, const std::string& frame,
                                         urban_nav_core::StampNs stamp);
urban_nav_msgs::MapQuality toMapQualityMessage(const MapQuality& quality, const std::string& frame,
                                               urban_nav_core::StampNs stamp);

}  // namespace laser_mapper
