// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "urban_nav_sim/measurement.hpp"
#include "urban_nav_sim/sensor.hpp"

namespace urban_nav_sim {

/// Measurement times of a device: `phase`, then every `period`, s of the session. Devices are not synchronised.
struct Schedule {
  double period = 1.0, phase = 0.0;

  double at(std::int64_t k) const { return phase + static_cast<double>(k) * period; }
  /// Returns the number of measurements before `duration`.
  std::int64_t count(double duration) const;
};

/// The rates of the paper's robot (Smith et al. 2009): stereo 20 Hz, Ladybug 2 Hz, lasers one revolution in 13.3381 ms
/// (time of the first beam; the right laser 5.54 ms after the left one), IMU 100 Hz, wheels every 36 ms, GPS 1 Hz. The
/// 3D LiDAR: 10 Hz, time of the end of the sweep.
Schedule sensorSchedule(Sensor sensor);
Schedule laserSchedule(Side side);
Schedule truthSchedule();  ///< 200 Hz

}  // namespace urban_nav_sim
