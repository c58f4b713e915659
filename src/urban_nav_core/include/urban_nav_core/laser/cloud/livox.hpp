// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "urban_nav_core/laser/cloud/cloud_view.hpp"

namespace urban_nav_core {

/// Serialization of a message: that of ROS 1, or CDR of ROS 2 with its encapsulation header.
enum class LivoxEncoding { Ros1, Cdr, CdrBigEndian };

/// CustomMsg of the Livox drivers (livox_ros_driver, livox_ros_driver2). The cloud has the fields offset_time (uint32,
/// ns after the beginning of the frame), x, y, z (float32, m), reflectivity, tag and line (uint8).
struct LivoxCloud {
  std::string frame;
  CloudView view;  ///< of the bytes of the message
};

/// Returns the cloud of a message; nullopt if its bytes end before the points. Declared points without bytes are
/// counted by CloudPoints::missing().
std::optional<LivoxCloud> parseLivox(const std::uint8_t* bytes, std::size_t size, LivoxEncoding encoding);

/// Returns the ROS 1 message definition, with those of nested types. `package`: of the driver.
std::string livoxDefinition(const std::string& package);

}  // namespace urban_nav_core
