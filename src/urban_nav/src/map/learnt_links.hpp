// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "map/context.hpp"

namespace urban_nav {

// Places learn from closures that the pose graph has accepted. Where these confirm places before the last session of a
// group, places are recognised again, each session with what the earlier ones were confirmed to show. A link that the
// graph then rejects is left out, and places are recognised once more. Groups are divided after that, so that sessions
// are apart only if learning does not join them; in each part learning starts anew.

/// Returns the links of measured closures by the verdicts of the pose graph, accepted ones and withdrawn ones, with
/// sessions by their ids, in the order of the later pose and then of the earlier one. Closures that wait for others
/// have none. Two poses have one link; it is accepted if any of their closures is.
std::vector<urban_nav_store::PlaceLink> linksOfGraph(const MapContext& context,
                                                     const std::vector<urban_nav_core::MetricClosure>& closures,
                                                     const std::vector<ClosureAssessment>& assessments);

/// Returns the links with which places have to be recognised again: at first those accepted that a later session of
/// their group can learn from, then MapContext::learnt without those that are withdrawn. nullopt if the last
/// recognition is final. `links`: of the last pose graph.
std::optional<std::vector<urban_nav_store::PlaceLink>> linksToLearn(
    const MapContext& context, const std::vector<urban_nav_store::PlaceLink>& links);

/// Stores accepted links. Withdrawn ones replace stored ones.
void storeLinks(urban_nav_store::Store& store, const std::vector<urban_nav_store::PlaceLink>& links);

/// Returns the accepted links from which recognition learns now: MapContext::learnt, and those of the store for
/// sessions whose places are known.
std::vector<urban_nav_store::PlaceLink> knownLinks(const MapContext& context);

}  // namespace urban_nav
