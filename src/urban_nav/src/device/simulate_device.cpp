// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulate_device.hpp"

#include <utility>

#include "device/session_readings.hpp"
#include "urban_nav_sim/ros/bag_readings.hpp"

namespace urban_nav {

std::int64_t simulateDevice(const SimulateDeviceJob& job, const std::function<bool()>& stop) {
  const std::string& kind = job.device.kind;
  urban_nav_sim::DeviceReadings readings = job.bag.empty() ? simulateReadings(job.session, kind, job.side)
                                                           : urban_nav_sim::readBagReadings(job.bag, kind, job.side);
  return urban_nav_sim::runSimulatedDevice(job.device, std::move(readings), stop);
}

}  // namespace urban_nav
