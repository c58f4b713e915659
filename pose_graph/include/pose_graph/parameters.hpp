// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace pose_graph {

/// User parameters of the stage; one member per row of table().
struct Parameters {
  std::string solver;            // gauss_newton; with references: relative_pcg, ceres
  bool robust;                   // reject false closures
  bool gravity;                  // corrects the drift of roll and pitch of odometry
  bool gps;                      // uses position fixes of satellite navigation
  double gps_correlation;        // s
  int iterations;                // limit for one minimisation
  double confirmation_distance;  // m
  double confirmation_angle;     // deg

  Parameters();
};

/// Returns the table with default, range, unit and description of each parameter.
const urban_nav_core::Table<Parameters>& table();

}  // namespace pose_graph
