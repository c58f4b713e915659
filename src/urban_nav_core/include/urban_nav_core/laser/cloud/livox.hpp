// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "urban_nav_core/laser/cloud/cloud_view.hpp"

namespace urban_nav_core {

/// Serialization of a message: as ROS 1 does it, or in CDR of ROS 2 with its encapsulation header.
enum class LivoxEncoding { Ros1, Cdr, CdrBigEndian };

/// A CustomMsg of the drivers of Livox (livox_ros_driver, livox_ros_driver2). The cloud has the fields offset_time
/// (uint32, ns after the begin of the frame), x, y, z (float32, m), reflectivity, tag and line (uint8).
struct LivoxCloud {
  std::string frame;
  CloudView view;  ///< of the bytes of the message
};

/// Returns the cloud in a message; nullopt if its bytes end before its points begin. Points that are announced without
/// bytes are those that CloudPoints::missing() counts.
std::optional<LivoxCloud> parseLivox(const std::uint8_t* bytes, std::size_t size, LivoxEncoding encoding);

/// Returns the definition of the message in the language of ROS 1, with those of the types within it. `package`: of the
/// driver.
std::string livoxDefinition(const std::string& package);

}  // namespace urban_nav_core
