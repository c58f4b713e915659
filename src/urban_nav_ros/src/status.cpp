// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/status.hpp"

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::Health;
using urban_nav_msgs::StageStatus;

std::uint8_t toMessage(Health health) {
  switch (health) {
    case Health::Ok: return StageStatus::OK;
    case Health::Degraded: return StageStatus::DEGRADED;
    case Health::Lost: return StageStatus::LOST;
    case Health::Recovered: return StageStatus::RECOVERED;
  }
  return StageStatus::LOST;
}

std::optional<Health> toHealth(std::uint8_t value) {
  switch (value) {
    case StageStatus::OK: return Health::Ok;
    case StageStatus::DEGRADED: return Health::Degraded;
    case StageStatus::LOST: return Health::Lost;
    case StageStatus::RECOVERED: return Health::Recovered;
    default: return std::nullopt;
  }
}

StageStatus toStatusMessage(urban_nav_core::StampNs stamp, const std::string& stage,
                            const urban_nav_core::Status& status, const std::string& reason_name) {
  StageStatus message;
  message.header.stamp = toRosTime(stamp);
  message.stage = stage;
  message.status = toMessage(status.health);
  message.reason = status.reason;
  message.reason_name = reason_name;
  message.message = status.sentence;
  return message;
}

}  // namespace urban_nav_ros
