// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/sequence/motion_input_parameters.hpp"
#include "urban_nav_input/session/open.hpp"

namespace urban_nav_input {

/// Parameters of the readers of recordings: `input.motion_input` and so on. One member per row of inputTable().
struct InputParameters : urban_nav_core::MotionInputParameters {
  double right_delay, pairing_tolerance;                   // ms
  double baseline_scale;                                   // m
  std::string sessions;                                    // auto, apart, together
  std::string accelerometer_axes;                          // as parseAxisMap() reads
  double accelerometer_scale;                              // m/s2
  double gyroscope_scale;                                  // rad/s
  double wheels_scale;                                     // m
  double imu_delay, wheels_delay, gps_delay;               // ms
  double laser_left_delay, laser_right_delay;              // ms
  double laser_left_range_scale, laser_right_range_scale;  // m
  double laser_left_angle_scale, laser_right_angle_scale;  // rad
  double laser_left_time_scale, laser_right_time_scale;    // s
  std::string points_time;                                 // "auto", or as parsePointTimes() reads
  std::string points_deskewed;                             // auto, yes, no
  double points_near;                                      // m
  double points0_delay, points1_delay;                     // ms

  InputParameters();
};

const urban_nav_core::Table<InputParameters>& inputTable();

/// Sets the options that parameters state. Throws UserError for unknown axes.
void apply(const InputParameters& parameters, SourceOptions& options);

}  // namespace urban_nav_input
