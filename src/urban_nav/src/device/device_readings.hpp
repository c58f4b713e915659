// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_sim/device/simulated_base.hpp"
#include "urban_nav_sim/device/simulated_gps.hpp"
#include "urban_nav_sim/device/simulated_imu.hpp"
#include "urban_nav_sim/device/simulated_laser.hpp"

namespace urban_nav {

/// Measurements of one device in a session. Times are s since its first measurement.
struct DeviceReadings {
  std::vector<urban_nav_sim::LaserReading> lasers;
  std::vector<urban_nav_sim::ImuReading> imu;
  std::vector<urban_nav_sim::WheelReading> wheels;
  std::vector<urban_nav_sim::GpsReading> gps;
  double gps_begin = 0.0;  ///< UTC of the first fix, s since 1970
};

/// Reads the measurements of a device from a bag. `kind`: lms291, xsens_mti, segway_rmp, gps; `side`: of a laser.
/// Throws UserError, and DataError if the bag has none.
DeviceReadings readReadings(const std::string& bag, const std::string& kind, const std::string& side);

}  // namespace urban_nav
