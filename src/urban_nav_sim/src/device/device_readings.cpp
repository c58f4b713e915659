// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/device/device_readings.hpp"

#include <utility>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

const std::vector<std::string>& serialDeviceKinds() {
  static const std::vector<std::string> kinds = {"lms291", "xsens_mti", "segway_rmp", "gps"};
  return kinds;
}

std::unique_ptr<SimulatedDevice> makeSimulatedDevice(const std::string& kind, DeviceReadings readings,
                                                     const DeviceOptions& options, bool gpsd) {
  if (kind == "lms291") return std::make_unique<SimulatedLaser>(std::move(readings.lasers), options);
  if (kind == "xsens_mti") return std::make_unique<SimulatedImu>(std::move(readings.imu), options);
  if (kind == "segway_rmp") return std::make_unique<SimulatedBase>(std::move(readings.wheels), options);
  if (kind == "gps") return std::make_unique<SimulatedGps>(std::move(readings.gps), readings.gps_begin, gpsd, options);
  throw urban_nav_core::UserError("KIND", kind, "lms291, xsens_mti, segway_rmp, gps");
}

}  // namespace urban_nav_sim
