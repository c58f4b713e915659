// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include "urban_nav_core/camera/camera_info.hpp"

namespace urban_nav_ros {

/// Field by field; nothing is checked here: urban_nav_core/camera/camera_info.hpp does.
urban_nav_core::CameraInfo toCameraInfo(const sensor_msgs::CameraInfo& message);
/// The header is the caller's business.
sensor_msgs::CameraInfo toCameraInfoMessage(const urban_nav_core::CameraInfo& info);

}  // namespace urban_nav_ros
