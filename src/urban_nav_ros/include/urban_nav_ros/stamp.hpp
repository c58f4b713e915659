// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_ros {

/// Both directions are exact. ROS holds seconds as 32 unsigned bits: a stamp before 1970 or after 2106 is clamped to
/// the nearest that ROS can say.
urban_nav_core::StampNs toStampNs(const ros::Time& time);
ros::Time toRosTime(urban_nav_core::StampNs stamp);

}  // namespace urban_nav_ros
