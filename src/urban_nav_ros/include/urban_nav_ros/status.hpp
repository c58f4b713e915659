// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urban_nav_msgs/StageStatus.h>

#include <cstdint>
#include <optional>
#include <string>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_core/types/status.hpp"

namespace urban_nav_ros {

/// Conversions to the constants OK, DEGRADED, LOST, RECOVERED of the messages of urban_nav_msgs; reading returns empty
/// for any other number.
std::uint8_t toMessage(urban_nav_core::Health health);
std::optional<urban_nav_core::Health> toHealth(std::uint8_t value);

/// `reason_name`: the stage's name of status.reason.
urban_nav_msgs::StageStatus toStatusMessage(urban_nav_core::StampNs stamp, const std::string& stage,
                                            const urban_nav_core::Status& status, const std::string& reason_name);

}  // namespace urban_nav_ros
