// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/NavSatFix.h>

#include <optional>

#include "urban_nav_core/types/gps_reading.hpp"

namespace urban_nav_ros {

/// Converts a fix; nullopt for a message without one, or with numbers that are not finite or no angles. An unknown
/// covariance counts as 5 m, and 10 m up; standard deviations are at least 1 cm.
std::optional<urban_nav_core::GpsReading> toGpsReading(const sensor_msgs::NavSatFix& fix);

}  // namespace urban_nav_ros
