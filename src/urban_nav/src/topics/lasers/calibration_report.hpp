// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "topics/lasers/lasers_run.hpp"

namespace urban_nav {

/// Return the results of --calibrate, for the console, the report and summary.json; empty without it.
std::vector<std::string> calibrationSentences(const LasersRun& run);
std::vector<PageTable> calibrationTables(const LasersRun& run);
Json calibrationJson(const LasersRun& run);
/// Returns the delay of each device, ms: the mean over the sessions that constrain it, weighted by their information;
/// null if none does.
Json delaysJson(const LasersRun& run);

}  // namespace urban_nav
