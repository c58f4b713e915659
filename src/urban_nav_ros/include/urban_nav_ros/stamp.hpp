// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_ros {

/// Exact conversions in both directions. ROS stores seconds in 32 unsigned bits: stamps before 1970 or after 2106 are
/// clamped.
urban_nav_core::StampNs toStampNs(const ros::Time& time);
ros::Time toRosTime(urban_nav_core::StampNs stamp);

}  // namespace urban_nav_ros
