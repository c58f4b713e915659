// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "inspect/fleet_report.hpp"

namespace urban_nav {

/// Area that the sessions of one map have seen: within 5 m of their paths, on a grid of 1 m.
struct MapCoverage {
  std::string store, map;  ///< of FleetSession
  std::size_t sessions = 0, days = 0;
  double area_m2 = 0.0;
  double repeated_m2 = 0.0;  ///< seen on more than one day
  double newest_m2 = 0.0;    ///< seen on the last day for the first time
  std::string last_day;      ///< "2008-11-03"
};

/// Returns the coverage of each map of a fleet, the largest first.
std::vector<MapCoverage> computeCoverage(const Fleet& fleet);

/// Returns the section of the page with the areas, and the paths of the largest maps from above by robot.
Section coverageSection(const Fleet& fleet);
/// Returns `maps` of the JSON output.
Json coverageJson(const Fleet& fleet);

}  // namespace urban_nav
