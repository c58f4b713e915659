// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "urban_nav_sim/device/simulated_base.hpp"
#include "urban_nav_sim/device/simulated_gps.hpp"
#include "urban_nav_sim/device/simulated_imu.hpp"
#include "urban_nav_sim/device/simulated_laser.hpp"

namespace urban_nav_sim {

/// Measurements of one serial device in a session. Times are s since the begin of the session.
struct DeviceReadings {
  std::vector<LaserReading> lasers;
  std::vector<ImuReading> imu;
  std::vector<WheelReading> wheels;
  std::vector<GpsReading> gps;
  double gps_begin = 0.0;  ///< UTC at time 0, s since 1970
};

/// Kinds of serial devices: lms291, xsens_mti, segway_rmp, gps.
const std::vector<std::string>& serialDeviceKinds();
/// Returns a device of that kind that reproduces the readings. `gpsd`: whether a receiver uses the gpsd protocol.
/// Throws UserError for an unknown kind.
std::unique_ptr<SimulatedDevice> makeSimulatedDevice(const std::string& kind, DeviceReadings readings,
                                                     const DeviceOptions& options, bool gpsd);

}  // namespace urban_nav_sim
