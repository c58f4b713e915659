// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Names of coordinate frames in tf, in messages and in stores (REP 103, REP 105). Nodelets take map, odom and
/// kBaseLink from their parameters, whose defaults these are.
namespace urban_nav_core::frames {

constexpr const char* kMap = "map";
constexpr const char* kOdom = "odom";
constexpr const char* kBaseLink = "base_link";                      ///< on the ground between the wheels
constexpr const char* kStereoLeft = "stereo_left_optical_frame";    ///< z forward, x right, y down
constexpr const char* kStereoRight = "stereo_right_optical_frame";  ///< z forward, x right, y down
constexpr const char* kLaserLeft = "laser_left";
constexpr const char* kLaserRight = "laser_right";
constexpr const char* kLidar3d = "lidar3d";  ///< x forward, y left, z up
constexpr const char* kImu = "imu_link";
constexpr const char* kGps = "gps_link";

/// Returns the optical frame of a camera of the panoramic head, 0...5.
inline std::string ladybugCamera(int camera) { return "ladybug_camera" + std::to_string(camera) + "_optical_frame"; }

}  // namespace urban_nav_core::frames
