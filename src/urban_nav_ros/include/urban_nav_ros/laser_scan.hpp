// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <optional>
#include <string>

#include "urban_nav_core/laser/scan_check.hpp"

namespace urban_nav_ros {

/// A turn of a planar laser, field by field, in the laser's own `frame`. header.seq is the caller's business.
sensor_msgs::LaserScan toLaserScanMessage(const urban_nav_core::PlanarScan& scan, const std::string& frame);

/// The same back. Empty where the beams could not be placed: an angle or a time step that is not finite, no stamp, or
/// numbers in other units (checkUnits()). Intensities that are not as many as the ranges are left out. Limits of the
/// ranges that are not finite, or an upper one that is not above the lower one, are no limits; a time of the turn that
/// is not finite is unknown, 0.
std::optional<urban_nav_core::PlanarScan> toPlanarScan(const sensor_msgs::LaserScan& message,
                                                       const urban_nav_core::LaserConvention& convention = {});
/// Returns what is wrong with the units of a message.
urban_nav_core::ScanVerdict checkUnits(const sensor_msgs::LaserScan& message,
                                       const urban_nav_core::LaserConvention& convention = {});
/// Returns whether the upper limit of the ranges leaves none of them.
bool hasNoRangeLimit(const sensor_msgs::LaserScan& message);

}  // namespace urban_nav_ros
