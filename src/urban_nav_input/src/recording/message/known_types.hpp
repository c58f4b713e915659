// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace urban_nav_input {

/// ROS 1 type that the suite is built with.
struct KnownType {
  std::string md5, definition;
};

/// Returns a type of std_msgs, geometry_msgs, sensor_msgs, nav_msgs or tf2_msgs by its name ("sensor_msgs/Image");
/// nullopt for other types.
std::optional<KnownType> findKnownType(const std::string& type);

}  // namespace urban_nav_input
