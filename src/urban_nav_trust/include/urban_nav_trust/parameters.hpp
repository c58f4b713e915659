// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_trust {

/// Parameters of the tests; one member per row of table().
struct Parameters {
  double false_alarm;        // probability, of a test
  double unexplained_drift;  // %

  Parameters();
};

/// Returns the table, the only definition of defaults, ranges, units and descriptions of these parameters.
const urban_nav_core::Table<Parameters>& table();

}  // namespace urban_nav_trust
