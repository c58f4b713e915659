// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/sensor.hpp"

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

const char* toString(Sensor sensor) {
  switch (sensor) {
    case Sensor::Stereo: return "stereo";
    case Sensor::Ladybug: return "ladybug";
    case Sensor::Lasers: return "lasers";
    case Sensor::Imu: return "imu";
    case Sensor::Wheels: return "wheels";
    case Sensor::Gps: return "gps";
    case Sensor::Lidar3d: return "lidar3d";
  }
  return "";
}

std::string sensorList() {
  std::string list;
  for (const Sensor sensor : kAllSensors) list += (list.empty() ? "" : ", ") + std::string(toString(sensor));
  return list;
}

Sensor parseSensor(const std::string& word, const std::string& where) {
  for (const Sensor sensor : kAllSensors)
    if (word == toString(sensor)) return sensor;
  throw urban_nav_core::UserError(where, "sensor \"" + word + "\"", sensorList());
}

}  // namespace urban_nav_sim
