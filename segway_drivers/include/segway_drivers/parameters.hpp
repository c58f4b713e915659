// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace segway_drivers {

/// Parameters of all drivers; one member per row of table(). A row is named DEVICE.KEY.
struct Parameters {
  double lms291_latency_ms;
  int lms291_measuring_mode;
  bool lms291_configure;
  double xsens_mti_latency_ms;
  int xsens_mti_mode;
  int xsens_mti_settings;
  int xsens_mti_rate;
  double segway_rmp_latency_ms;
  double segway_rmp_max_velocity;
  double segway_rmp_max_turn_rate;
  double segway_rmp_acceleration;
  double segway_rmp_angular_acceleration;
  double segway_rmp_command_timeout;
  double gps_latency_ms;
  double gps_uere;
  double bumblebee2_latency_ms;
  std::string bumblebee2_pattern;
  std::string bumblebee2_rectify;
  std::string bumblebee2_calibration;
  std::string bumblebee2_camera_info;
  bool bumblebee2_swap_images;
  double ladybug2_latency_ms;
  double ladybug2_rate;
  int ladybug2_quality;
  std::string ladybug2_camera_order;
  std::string ladybug2_pattern;

  Parameters();
};

/// Returns the table, the only definition of defaults, ranges, units and descriptions.
const urban_nav_core::Table<Parameters>& table();

}  // namespace segway_drivers
