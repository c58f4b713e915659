// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <optional>
#include <string>

#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav_ros {

/// A turn of a planar laser, field by field, in the laser's own `frame`. header.seq is the caller's business.
sensor_msgs::LaserScan toLaserScanMessage(const urban_nav_core::PlanarScan& scan, const std::string& frame);

/// The same back. Empty where the beams could not be placed: an angle, a time step or a limit that is not finite, or no
/// stamp. Intensities that are not as many as the ranges are left out.
std::optional<urban_nav_core::PlanarScan> toPlanarScan(const sensor_msgs::LaserScan& message);

}  // namespace urban_nav_ros
