// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/sensor_counts.hpp"

#include <set>

namespace urban_nav {

std::map<std::string, std::size_t> SensorCounts::byName(const std::vector<laser_mapper::SensorName>& sensors) const {
  std::map<std::string, std::size_t> named;
  std::set<std::uint8_t> counted;
  for (const laser_mapper::SensorName& sensor : sensors) {
    if (!counted.insert(sensor.id).second) continue;  // at another frame in another session
    named[sensor.role == "laser" ? sensor.frame : sensor.role] += counts_[sensor.id];
  }
  return named;
}

std::vector<laser_mapper::SensorName> sensorNames(urban_nav_store::Store& store,
                                                  const std::vector<laser_mapper::MappedSession>& sessions) {
  std::vector<urban_nav_store::SessionId> ids;
  for (const laser_mapper::MappedSession& session : sessions) ids.push_back(session.id);
  return laser_mapper::storedSensors(store, ids);
}

}  // namespace urban_nav
