// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <map>
#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_ros {

/// All parameters in the name space of the handle, a nodelet's private one as a rule, for
/// urban_nav_core::serverParameters. Throws UserError for one that is neither bool, number nor text, naming it.
std::map<std::string, urban_nav_core::ParameterValue> serverValues(const ros::NodeHandle& nh);

}  // namespace urban_nav_ros
