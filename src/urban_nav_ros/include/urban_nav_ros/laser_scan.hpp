// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <optional>
#include <string>

#include "urban_nav_core/laser/scan_check.hpp"

namespace urban_nav_ros {

/// A turn of a planar laser, field by field, in the laser's own `frame`. header.seq is the caller's business.
sensor_msgs::LaserScan toLaserScanMessage(const urban_nav_core::PlanarScan& scan, const std::string& frame);

/// Returns the scan of a message; nullopt where the beams cannot be placed: without a stamp, with numbers in other
/// units (checkUnits()), or with angles of which less than two are known. One of angle_min, angle_max and
/// angle_increment follows from the others where it is not finite (an increment also where it is zero), and
/// time_increment from scan_time. Intensities that are not as many as the ranges are left out. Limits of the ranges
/// that are not finite, or an upper one that is not above the lower one, are no limits; a time of the turn that is not
/// finite is unknown, 0. Scales of `convention` apply to those numbers that are in its units: limits in metres with
/// ranges in millimetres, and one angle in radians with others in degrees, stay as they are.
std::optional<urban_nav_core::PlanarScan> toPlanarScan(const sensor_msgs::LaserScan& message,
                                                       const urban_nav_core::LaserConvention& convention = {});
/// Returns what is wrong with the units of a message.
urban_nav_core::ScanVerdict checkUnits(const sensor_msgs::LaserScan& message,
                                       const urban_nav_core::LaserConvention& convention = {});
/// Returns whether the upper limit of the ranges leaves none of them.
bool hasNoRangeLimit(const sensor_msgs::LaserScan& message);

}  // namespace urban_nav_ros
