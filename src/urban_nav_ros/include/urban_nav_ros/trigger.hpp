// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <functional>
#include <string>

namespace urban_nav_ros {

/// A service of type std_srvs/Trigger. `action` returns what was done, which is the answer's message; empty: it was not
/// done, and the answer says no.
ros::ServiceServer advertiseTrigger(ros::NodeHandle& nh, const std::string& name,
                                    const std::function<std::string()>& action);

}  // namespace urban_nav_ros
