// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <utility>

#include "live/nodelet_parameters.hpp"
#include "segway_drivers/parameters.hpp"

namespace segway_drivers {

/// Reads rows of the nodelet and keys of its device, which stand side by side in the private namespace. `device`:
/// prefix of the device's rows in the table. Throws UserError with an unknown parameter or a value out of
/// range.
std::pair<NodeletParameters, Parameters> readDeviceParameters(const ros::NodeHandle& private_handle,
                                                              const std::string& device);

}  // namespace segway_drivers
