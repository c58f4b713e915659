// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "urban_nav_sim/device/device_readings.hpp"

namespace urban_nav_sim {

/// A simulated device and where the host finds it.
struct SimulatedDeviceJob {
  std::string kind;   ///< of serialDeviceKinds()
  std::string link;   ///< path of the port
  int tcp = 0;        ///< gps: port at which gpsd's protocol is served instead; 0: none
  std::string truth;  ///< file of `sequence,true_ns`, or empty
  std::string begin;  ///< file in which devices agree on the begin of the session; empty: at once
  bool held = false;  ///< there is no port before another process has written that file
  DeviceOptions options;
};

/// Runs a simulated device in real time until its session ends or `stop` returns true, then writes the truth. Returns
/// the number of measurements. Blocks. Throws UserError for a wrong job, DataError if the port cannot be made.
std::int64_t runSimulatedDevice(const SimulatedDeviceJob& job, DeviceReadings readings,
                                const std::function<bool()>& stop);

}  // namespace urban_nav_sim
