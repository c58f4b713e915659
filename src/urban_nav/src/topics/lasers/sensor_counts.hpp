// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/sensors.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Numbers of points by sensor.
class SensorCounts {
 public:
  /// `sensor`: MapPoint::laser.
  void add(std::uint8_t sensor) { ++counts_[sensor]; }
  /// Returns the counts of these sensors under their names: roles; frames for planar lasers at other frames than the
  /// two of the robot, which share one role.
  std::map<std::string, std::size_t> byName(const std::vector<laser_mapper::SensorName>& sensors) const;

 private:
  std::array<std::size_t, 256> counts_{};
};

/// Returns the sensors with stored measurements in the sessions of a map.
std::vector<laser_mapper::SensorName> sensorNames(urban_nav_store::Store& store,
                                                  const std::vector<laser_mapper::MappedSession>& sessions);

}  // namespace urban_nav
