// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_report.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>

namespace laser_mapper {

const char* toString(MapFault fault) {
  switch (fault) {
    case MapFault::None: return "None";
    case MapFault::NoOdometry: return "NoOdometry";
    case MapFault::NoLasers: return "NoLasers";
    case MapFault::NoLaserPlace: return "NoLaserPlace";
    case MapFault::UnusableDepth: return "UnusableDepth";
    case MapFault::NotStored: break;
  }
  return "NotStored";
}

urban_nav_live::StageReport reportOnMap(const LiveMap::Counts& counts, const MapFaults& faults) {
  const LiveSensors::Counts& sensors = counts.sensors;
  MapFault fault = MapFault::None;
  std::string sentence;
  const auto set = [&](MapFault as, const std::string& text) {
    if (text.empty() || fault != MapFault::None || faults.is_paused) return;
    fault = as;
    sentence = text;
  };
  set(MapFault::NotStored, faults.store);
  set(MapFault::NoOdometry, faults.odometry);
  set(MapFault::NoLasers, faults.clouds);
  set(MapFault::UnusableDepth, faults.depth);
  set(MapFault::NoLaserPlace, faults.places);
  if (sensors.sweeps + sensors.depth_images + sensors.stereo_views == 0) set(MapFault::NoLasers, faults.lasers);
  urban_nav_live::StageReport report;
  if (fault != MapFault::None) report.status = {urban_nav_core::Health::Degraded, static_cast<int>(fault), sentence};
  report.reason_name = toString(fault);
  report.is_error = fault == MapFault::NotStored;
  report.add("scans", sensors.scans);
  report.add("sweeps stored", sensors.sweeps);
  report.add("images of depth cameras stored", sensors.depth_images);
  report.add("depths of dense stereo stored", sensors.stereo_views);
  report.add("measurements of sensors without a pose on the robot", sensors.unplaced);
  report.add("poses of odometry", counts.poses);
  report.add("revisions of the graph missed", counts.updates_missed);
  report.add("points", counts.points);
  report.add("chunks", counts.chunks);
  report.add("chunks rendered last", counts.chunks_rendered);
  return report;
}

std::string temporaryStore(const std::string& node) {
  std::string name = node;
  std::replace(name.begin(), name.end(), '/', '_');
  return (std::filesystem::temp_directory_path() / ("laser_mapper" + name + "_" + std::to_string(::getpid()) + ".db"))
      .string();
}

}  // namespace laser_mapper
