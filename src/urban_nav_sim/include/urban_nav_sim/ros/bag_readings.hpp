// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_sim/device/device_readings.hpp"

namespace urban_nav_sim {

/// Reads the measurements of a device from a bag; the session begins with the bag. `kind`: of serialDeviceKinds();
/// `side`: of a laser, left or right. A magnetic field or velocity missing in the bag is 0. Throws UserError for an
/// unreadable bag, DataError if it has no measurements of the device.
DeviceReadings readBagReadings(const std::string& bag, const std::string& kind, const std::string& side);

}  // namespace urban_nav_sim
