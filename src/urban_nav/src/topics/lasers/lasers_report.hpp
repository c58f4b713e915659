// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "topics/lasers/lasers_run.hpp"

namespace urban_nav {

/// Returns the section of the report: pictures, and statistics of the beams.
Section lasersSection(const LasersRun& run);
std::vector<Tile> lasersTiles(const LasersRun& run);
/// Returns defects of the data, for the console and the report.
std::vector<std::string> lasersWarnings(const LasersRun& run);
/// Returns the object of summary.json.
Json toJson(const LasersRun& run);

}  // namespace urban_nav
