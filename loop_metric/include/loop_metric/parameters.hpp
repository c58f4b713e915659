// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/parameters/table.hpp"
#include "urban_nav_registration/parameters.hpp"

namespace loop_metric {

/// Parameters of loop closures; one member per row of table(), and those of the registration.
struct Parameters {
  bool stereo;                      // enabled
  bool icp;                         // enabled, used if stereo fails
  int stereo_tries;                 // pairs of views
  double keyframe_search_distance;  // m
  double place_radius;              // m
  double gate;                      // standard deviations

  urban_nav_registration::Parameters registration;  ///< in a separate table

  Parameters();
};

/// The parameter table: the single source of defaults, ranges, units and descriptions.
const urban_nav_core::Table<Parameters>& table();

}  // namespace loop_metric
