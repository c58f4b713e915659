// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_sim/device/simulated_base.hpp"
#include "urban_nav_sim/device/simulated_gps.hpp"
#include "urban_nav_sim/device/simulated_imu.hpp"
#include "urban_nav_sim/device/simulated_laser.hpp"

namespace urban_nav {

/// Measurements of a recorded session that simulated devices send again. Times are s since the first measurement of the
/// kind.
std::vector<urban_nav_sim::LaserReading> readLaserReadings(const std::string& bag, const std::string& side);
std::vector<urban_nav_sim::ImuReading> readImuReadings(const std::string& bag);
std::vector<urban_nav_sim::WheelReading> readWheelReadings(const std::string& bag);
/// `begin`: UTC of the first fix, s since 1970.
std::vector<urban_nav_sim::GpsReading> readGpsReadings(const std::string& bag, double& begin);

}  // namespace urban_nav
