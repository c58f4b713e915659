// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/json.hpp"
#include "topics/places/places_run.hpp"

namespace urban_nav {

/// Returns the section on place recognition: probability of the likeliest place over time, recognised places side by
/// side (Newman et al. 2009, Figs. 6 and 7), and observations that were not used.
Section placesSection(const PlacesRun& run, const std::vector<PagePicture>& pictures);

/// Returns the main finding.
std::vector<Verdict> placesVerdicts(const PlacesRun& run);

/// Returns the object "fabmap_node" of summary.json. `ms_features`: per observation.
Json toJson(const PlacesRun& run, const std::vector<double>& ms_features);

}  // namespace urban_nav
