// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_sim/device/device_readings.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav {

/// Simulates a session of the robot with the sensor of one device, before the device is started: rendering is slower
/// than real time. `side`: of a laser. Times are s since the first measurement. Throws UserError for an unknown world,
/// route or device.
urban_nav_sim::DeviceReadings simulateReadings(urban_nav_sim::SessionOptions options, const std::string& kind,
                                               const std::string& side);

}  // namespace urban_nav
