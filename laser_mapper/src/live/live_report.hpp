// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "live/live_map.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace laser_mapper {

/// Reasons of the status of a live map.
enum class MapFault {
  None = 0,
  NoOdometry = 1,
  NoLasers = 2,
  NoLaserPlace = 3,
  NotStored = 4,
  UnusableDepth = 5,
};
const char* toString(MapFault fault);

/// Faults of a live map; empty: none.
struct MapFaults {
  std::string store, odometry, clouds, depth, places, lasers;
  bool is_paused = false;
};

/// Returns the status, the most severe fault first, and the counts for the operator.
urban_nav_live::StageReport reportOnMap(const LiveMap::Counts& counts, const MapFaults& faults);

/// Returns a path for the temporary store of a node.
std::string temporaryStore(const std::string& node);

}  // namespace laser_mapper
