// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace pose_graph {

/// What a user may want to change; one member per row of table().
struct Parameters {
  std::string solver;            // gauss_newton; with references: relative_pcg, ceres
  bool robust;                   // reject false closures
  bool gravity;                  // takes the drift of roll and pitch out of odometry
  bool gps;                      // fixes of satellite navigation are used
  double gps_correlation;        // s
  int iterations;                // of one minimisation, at most
  double confirmation_distance;  // m
  double confirmation_angle;     // deg

  Parameters();
};

/// The table: the only place where a default, a range, a unit or a sentence about a parameter stands.
const urban_nav_core::Table<Parameters>& table();

}  // namespace pose_graph
