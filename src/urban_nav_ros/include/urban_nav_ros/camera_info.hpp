// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include "urban_nav_core/camera/camera_info.hpp"

namespace urban_nav_ros {

/// Converts field by field, without checks; see urban_nav_core/camera/camera_info.hpp.
urban_nav_core::CameraInfo toCameraInfo(const sensor_msgs::CameraInfo& message);
/// Converts to a message. Sets no header.
sensor_msgs::CameraInfo toCameraInfoMessage(const urban_nav_core::CameraInfo& info);

}  // namespace urban_nav_ros
