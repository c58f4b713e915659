// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Names of coordinate frames in tf, in messages and in stores (REP 103, REP 105). Nodelets take map, odom and
/// base_link from their parameters, whose defaults these are.
namespace urban_nav_core::frames {

constexpr const char* map = "map";
constexpr const char* odom = "odom";
constexpr const char* base_link = "base_link";                      ///< on the ground between the wheels
constexpr const char* stereo_left = "stereo_left_optical_frame";    ///< z forward, x right, y down
constexpr const char* stereo_right = "stereo_right_optical_frame";  ///< z forward, x right, y down
constexpr const char* laser_left = "laser_left";
constexpr const char* laser_right = "laser_right";
constexpr const char* imu = "imu_link";
constexpr const char* gps = "gps_link";

/// Returns the optical frame of a camera of the panoramic head, 0...5.
inline std::string ladybugCamera(int camera) { return "ladybug_camera" + std::to_string(camera) + "_optical_frame"; }

}  // namespace urban_nav_core::frames
