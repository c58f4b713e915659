// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/json.hpp"
#include "topics/trust/trust_run.hpp"

namespace urban_nav {

/// Returns trust.csv: a row for each pose of the trajectories.
std::string trustCsv(const TrustRun& run);
/// Returns the object of summary.json.
Json toJson(const TrustRun& run, const urban_nav_trust::Parameters& parameters);
/// Returns the names of the tests that fail, each once.
std::vector<std::string> failedTests(const TrustRun& run, const urban_nav_trust::Parameters& parameters);

}  // namespace urban_nav
