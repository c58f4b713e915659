// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urban_nav_msgs/VoStatistics.h>

#include <optional>

#include "urban_nav_core/sequence/right_camera_turns.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

/// Returns the turn of the right camera of a frame; nullopt for a frame that odometry dropped.
inline std::optional<urban_nav_core::StampedTurn> toStampedTurn(const urban_nav_msgs::VoStatistics& message) {
  if (!message.accepted) return std::nullopt;
  return urban_nav_core::StampedTurn{toStampNs(message.header.stamp),
                                     urban_nav_core::Vector3d(message.right_turn.data())};
}

}  // namespace urban_nav_ros
