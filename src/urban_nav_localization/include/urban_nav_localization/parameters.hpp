// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/parameters/table.hpp"
#include "urban_nav_registration/parameters.hpp"

namespace urban_nav_localization {

/// Parameters of localisation; one member per row of table(), and those of the registration.
struct Parameters {
  bool icp;          // try it where stereo fails
  double gate;       // standard deviations
  double map_sigma;  // m

  urban_nav_registration::Parameters registration;  ///< not part of table(): a table of its own

  Parameters();
};

/// The table: the only definition of the defaults, ranges, units and descriptions of these parameters.
const urban_nav_core::Table<Parameters>& table();

}  // namespace urban_nav_localization
