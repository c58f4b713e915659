// SPDX-License-Identifier: BSD-3-Clause
#include "device_parameters.hpp"

#include <algorithm>
#include <map>

#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_ros/parameters.hpp"

namespace segway_drivers {

std::pair<NodeletParameters, Parameters> readDeviceParameters(const ros::NodeHandle& private_handle,
                                                              const std::string& device) {
  std::map<std::string, urban_nav_core::ParameterValue> own, of_device;
  const auto& rows = nodeletTable().rows();
  for (const auto& [name, value] : urban_nav_ros::serverValues(private_handle)) {
    const bool is_own =
        std::any_of(rows.begin(), rows.end(), [&, &key = name](const auto& row) { return row.name == key; });
    if (is_own) own[name] = value;
    else of_device[device + "." + name] = value;
  }
  const std::string where = private_handle.getNamespace();
  return {load(nodeletTable(), urban_nav_core::serverParameters("", own, where)).parameters,
          load(table(), urban_nav_core::serverParameters(table().stage(), of_device, where)).parameters};
}

}  // namespace segway_drivers
