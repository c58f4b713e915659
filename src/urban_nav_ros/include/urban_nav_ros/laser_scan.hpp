// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <optional>
#include <string>

#include "urban_nav_core/laser/scan_check.hpp"

namespace urban_nav_ros {

/// Converts a scan of a planar laser in the laser's own `frame`. Does not set header.seq.
sensor_msgs::LaserScan toLaserScanMessage(const urban_nav_core::PlanarScan& scan, const std::string& frame);

/// Returns the scan of a message; nullopt without a stamp, with other units (checkUnits()), or if fewer than two of the
/// angles are known. One of angle_min, angle_max and angle_increment is derived from the others if it is not finite (an
/// increment also if it is zero), and time_increment from scan_time. Intensities are dropped unless there is one per
/// range. Range limits that are not finite, or whose order is reversed, are ignored; a scan_time that is not finite
/// becomes 0 (unknown). Scales of `convention` apply only to numbers in its units: limits in metres with ranges in
/// millimetres, and one angle in radians with others in degrees, are not scaled.
std::optional<urban_nav_core::PlanarScan> toPlanarScan(const sensor_msgs::LaserScan& message,
                                                       const urban_nav_core::LaserConvention& convention = {});
/// Returns the fault of the units of a message.
urban_nav_core::ScanVerdict checkUnits(const sensor_msgs::LaserScan& message,
                                       const urban_nav_core::LaserConvention& convention = {});
/// Returns whether the upper range limit excludes all ranges.
bool hasNoRangeLimit(const sensor_msgs::LaserScan& message);

}  // namespace urban_nav_ros
