// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/page.hpp"
#include "topics/lo/lo_run.hpp"
#include "topics/lo/lo_summary.hpp"

namespace urban_nav {

/// Returns the sections on one session: map from above with the path, uncertainty, free directions, residuals, time.
std::vector<Section> loSections(const LoRun& run);

/// Returns the verdicts on laser odometry.
std::vector<Verdict> loVerdicts(const LoSummary& summary);

}  // namespace urban_nav
