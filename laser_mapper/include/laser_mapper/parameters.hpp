// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace laser_mapper {

/// Parameters of the map, one member per row of table().
struct Parameters {
  double voxel;        // m
  double min_range;    // m
  double max_range;    // m
  double range_sigma;  // m
  double range_bias;   // m
  double beam_width;   // rad
  bool mixed_pixels;
  bool ghosts;
  double ghost_gap;  // s
  bool stereo;
  double stereo_sigma;  // m
  double depth_sigma;   // m at 1 m
  double max_gap;       // s
  double max_shift;     // m
  bool constraints;

  Parameters();
};

/// Returns the table, the only definition of defaults, ranges, units and descriptions of these parameters.
const urban_nav_core::Table<Parameters>& table();

}  // namespace laser_mapper
