// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_sim {

std::int64_t Schedule::count(double duration) const {
  return std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil((duration - phase) / period - 1e-9)));
}

Schedule sensorSchedule(Sensor sensor) {
  switch (sensor) {
    case Sensor::Stereo: return {0.05, 0.012};
    case Sensor::Ladybug: return {0.5, 0.137};
    case Sensor::Lasers: return laserSchedule(Side::Left);
    case Sensor::Imu: return {0.01, 0.01};
    case Sensor::Wheels: return {0.036, 0.007};
    case Sensor::Gps: return {1.0, 0.5};
    case Sensor::Lidar3d: return {0.1, 0.121};
  }
  return {};
}

Schedule laserSchedule(Side side) {
  const double left = 0.003;
  return {13.3381e-3, side == Side::Left ? left : left + 5.54e-3};
}

Schedule truthSchedule() { return {0.005, 0.0}; }

}  // namespace urban_nav_sim
