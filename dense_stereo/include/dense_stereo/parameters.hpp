// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace dense_stereo {

/// Parameters of the stage, one member per row of table().
struct Parameters {
  std::string method;        // sgm, paper (requires a matcher for DenseStereo)
  int disparities;           // px
  int min_component;         // px
  double max_sigma;          // px
  double max_range;          // m
  double obstacle_height;    // m
  double clearance;          // m
  double point_spacing;      // m
  double keyframe_distance;  // m
  double keyframe_angle;     // rad
  double keyframe_interval;  // s

  Parameters();
};

/// Returns the table, the only definition of defaults, ranges, units and descriptions of these parameters.
const urban_nav_core::Table<Parameters>& table();

}  // namespace dense_stereo
