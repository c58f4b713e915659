// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/page.hpp"
#include "topics/trust/trust_run.hpp"

namespace urban_nav {

/// Returns the first line of the report: the assessment of the map.
Verdict trustVerdict(const TrustRun& run, const urban_nav_trust::Parameters& parameters);
/// Returns the section with the tests, the missing comparisons, and the probabilities over time.
Section trustSection(const TrustRun& run, const urban_nav_trust::Parameters& parameters);

}  // namespace urban_nav
