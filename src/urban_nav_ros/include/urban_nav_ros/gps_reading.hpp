// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/NavSatFix.h>

#include <optional>

#include "urban_nav_core/types/gps_reading.hpp"

namespace urban_nav_ros {

/// Converts a fix; nullopt for a message without one, with numbers that are no angles, or at latitude 0, longitude 0,
/// where receivers without a fix are. Without an altitude, the height is 0 with a deviation of 10 km. An unknown
/// covariance counts as 5 m, and 10 m up; standard deviations are at least 1 cm.
std::optional<urban_nav_core::GpsReading> toGpsReading(const sensor_msgs::NavSatFix& fix);

}  // namespace urban_nav_ros
