// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/NavSatFix.h>

#include <optional>

#include "urban_nav_core/types/gps_reading.hpp"

namespace urban_nav_ros {

/// Converts a fix; nullopt for a message without one, with invalid angles, or at latitude 0, longitude 0, which
/// receivers without a fix report. Without an altitude, the height is 0 with a standard deviation of 10 km. An unknown
/// covariance is replaced by 5 m, and 10 m vertically; standard deviations are at least 1 cm.
std::optional<urban_nav_core::GpsReading> toGpsReading(const sensor_msgs::NavSatFix& fix);

}  // namespace urban_nav_ros
