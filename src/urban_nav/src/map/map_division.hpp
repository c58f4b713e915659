// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "map/context.hpp"
#include "map/stage_list.hpp"

namespace urban_nav {

// Recognition compares a place with all earlier ones: similar places of another town lower its probability, and change
// the choice of closures. So that the map of a site does not depend on sessions elsewhere, places are recognised again
// among the sessions of each map that the pose graph has found, until no map divides further. The closures of each map
// are then those that its sessions have without the others.

/// Returns whether a run finds the closures of all its sessions from their places, so that it can divide them.
bool canDivide(const MapContext& context, const StageList& stages);

/// Returns whether a stage of this name runs again after the groups were divided: places, loops, graph.
bool isRepeatedByMap(const std::string& name);

/// Returns the groups of sessions within which places are recognised, over all sessions: those of the context, divided
/// further. `maps`: the map of each session. A group has the number of its first session.
std::vector<std::size_t> dividedGroups(const MapContext& context, const std::vector<std::size_t>& maps);

/// Returns the sessions of each group, in order of their numbers; groups in the order of their first sessions.
std::vector<std::vector<std::size_t>> sessionsOfGroups(const MapContext& context);

/// Returns whether the places of a session are known from the beginning: of a release, or of an earlier run that this
/// one does not join again.
bool hasKnownPlaces(const MapContext& context, std::size_t session);

/// Returns the sessions of a group in the order of recognition: those with known places first.
std::vector<std::size_t> recognitionOrder(const MapContext& context, std::vector<std::size_t> group);

/// Sets the groups of the context, in which nothing is learnt yet. `closures`: with the verdicts of the pose graph,
/// `assessments`. Those between sessions that are no longer in one group become rejected candidates in
/// MapContext::between_groups.
void divideGroups(const std::vector<std::size_t>& groups, const std::vector<urban_nav_core::MetricClosure>& closures,
                  const std::vector<ClosureAssessment>& assessments, MapContext& context);

}  // namespace urban_nav
