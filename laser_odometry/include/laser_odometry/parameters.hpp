// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/parameters/table.hpp"

namespace laser_odometry {

/// Parameters of the stage; table() has description, unit, default and range of each.
struct Parameters {
  double cell;                  // m
  int levels;                   // resolutions
  double min_range;             // m
  double max_range;             // m
  double map_range;             // m
  bool deskew;                  //
  int iterations;               // per round
  int rounds;                   //
  double surface_sigma;         // m
  double acceleration;          // m/s^2
  double angular_acceleration;  // rad/s^2
  int lost_patches;             //
  int degraded_patches;         //
  double planar_cell;           // m
  double planar_min_range;      // m
  double floor_height;          // m after 1 m
  double floor_tilt;            // deg

  Parameters();
};

/// Returns the table of the stage's parameters: the single source of defaults and ranges. Thread-safe.
const urban_nav_core::Table<Parameters>& table();

}  // namespace laser_odometry
