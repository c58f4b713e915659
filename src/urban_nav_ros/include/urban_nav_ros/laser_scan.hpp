// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <string>

#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav_ros {

/// A turn of a planar laser, field by field, in the laser's own `frame`. header.seq is the caller's business.
sensor_msgs::LaserScan toLaserScanMessage(const urban_nav_core::PlanarScan& scan, const std::string& frame);

}  // namespace urban_nav_ros
