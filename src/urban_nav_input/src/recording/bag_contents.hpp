// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <list>
#include <map>
#include <string>

#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// Returns the type of every topic of some bags, by name.
std::map<std::string, std::string> topicTypes(std::list<rosbag::Bag>& bags);

/// Returns the transforms of /tf_static, and for children that it lacks those of /tf whose links stay the same to 1 mm
/// and 0.1 deg throughout the bags: sensors whose places are published again and again. Looks at a thousand messages of
/// /tf, evenly distributed.
urban_nav_ros::StaticTransforms readTransforms(std::list<rosbag::Bag>& bags);

}  // namespace urban_nav_input
