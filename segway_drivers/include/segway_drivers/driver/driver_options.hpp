// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "segway_drivers/gps/driver.hpp"
#include "segway_drivers/lms291/driver.hpp"
#include "segway_drivers/parameters.hpp"
#include "segway_drivers/segway_rmp/driver.hpp"
#include "segway_drivers/xsens_mti/driver.hpp"

namespace segway_drivers {

/// Returns the options of each driver from the parameters.
LmsDriver::Options toLmsOptions(const Parameters& parameters);
MtiDriver::Options toMtiOptions(const Parameters& parameters);
RmpDriver::Options toRmpOptions(const Parameters& parameters);
/// `port`: HOST:PORT means gpsd.
GpsDriver::Options toGpsOptions(const Parameters& parameters, const std::string& port);

}  // namespace segway_drivers
