// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/sequence/motion_input_parameters.hpp"

namespace urban_nav_input {

/// Parameters of the readers of recordings: `input.motion_input` and so on. One member per row of inputTable().
struct InputParameters : urban_nav_core::MotionInputParameters {
  double right_delay;  // ms

  InputParameters();
};

const urban_nav_core::Table<InputParameters>& inputTable();

}  // namespace urban_nav_input
