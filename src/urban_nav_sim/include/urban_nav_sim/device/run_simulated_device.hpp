// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "urban_nav_sim/device/device_readings.hpp"

namespace urban_nav_sim {

/// A simulated device and its connection.
struct SimulatedDeviceJob {
  std::string kind;   ///< of serialDeviceKinds()
  std::string link;   ///< path of the port
  int tcp = 0;        ///< gps: port of the gpsd protocol instead; 0: none
  std::string truth;  ///< file of `sequence,true_ns`, or empty
  std::string begin;  ///< file by which devices begin their sessions together; empty: at once
  bool held = false;  ///< no port before another process has written that file
  DeviceOptions options;
};

/// Runs a simulated device in real time until its session ends or `stop` returns true, then writes the truth. Returns
/// the number of measurements. Blocks. Throws UserError for an invalid job, DataError if the port cannot be created.
std::int64_t runSimulatedDevice(const SimulatedDeviceJob& job, DeviceReadings readings,
                                const std::function<bool()>& stop);

}  // namespace urban_nav_sim
