// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/sequence/motion_input_parameters.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_ros/sensor_corrections.hpp"

namespace urban_nav_input {

/// Parameters of the readers of recordings: `input.motion_input` and so on. One member per row of inputTable().
struct InputParameters : urban_nav_core::MotionInputParameters, urban_nav_ros::SensorCorrectionParameters {
  double right_delay, pairing_tolerance;  // ms
  double baseline_scale;                  // m
  std::string sessions;                   // auto, apart, together
  std::string points_time;                // "auto", or a value of parsePointTimes()
  std::string points_deskewed;            // auto, yes, no
  double points_near;                     // m
  double points0_delay, points1_delay;    // ms

  InputParameters();
};

const urban_nav_core::Table<InputParameters>& inputTable();

/// Sets the options given by parameters. Throws UserError for unknown axes.
void apply(const InputParameters& parameters, SourceOptions& options);

}  // namespace urban_nav_input
