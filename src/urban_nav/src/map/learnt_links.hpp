// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "map/context.hpp"

namespace urban_nav {

// Places learn from the closures that the pose graph has accepted: `map` recognises the places of three or more
// sessions again, each session with what the earlier ones were confirmed to show; a run with --store knows the links of
// the runs before.

/// Returns the links between all sessions by the verdicts of the pose graph on measured closures, with sessions by
/// their ids: accepted ones, and withdrawn ones that `store` has as accepted. In the order of the closures.
std::vector<urban_nav_store::PlaceLink> acceptedLinks(urban_nav_store::Store& store, const MapContext& context,
                                                      const std::vector<urban_nav_core::MetricClosure>& closures,
                                                      const std::vector<ClosureAssessment>& assessments);

/// Returns whether places should be recognised again: they were not yet, and links join two sessions before a third one
/// of their group.
bool canLearn(const MapContext& context, const std::vector<urban_nav_store::PlaceLink>& links);

void storeLinks(urban_nav_store::Store& store, const std::vector<urban_nav_store::PlaceLink>& links);

/// Returns the accepted links from which recognition learns now: those of the context, else of previous sessions in the
/// store, unless the run joins them.
std::vector<urban_nav_store::PlaceLink> knownLinks(const MapContext& context);

}  // namespace urban_nav
