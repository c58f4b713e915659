// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <variant>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_ros/stereo_calibration.hpp"

namespace urban_nav_ros {

/// Image of one side as it arrived, raw or compressed.
struct ImageInput {
  Side side;
  std::variant<sensor_msgs::ImageConstPtr, sensor_msgs::CompressedImageConstPtr> message;
  urban_nav_core::StampNs stamp;
};

/// Calibration of one side.
struct InfoInput {
  Side side;
  sensor_msgs::CameraInfoConstPtr message;
};

/// Returns true if two messages describe the same camera, whatever their headers.
bool isSameCalibration(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b);

}  // namespace urban_nav_ros
