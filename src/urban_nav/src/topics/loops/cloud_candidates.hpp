// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "map/context.hpp"
#include "topics/loops/candidate_measurement.hpp"

namespace urban_nav {

/// Returns candidates for closures between places of sessions with odometry by laser, from the similarity of their
/// local clouds, among the sessions of each group. The store must be committed.
std::vector<urban_nav_core::TopologicalClosure> proposeByClouds(const MapContext& context,
                                                                const CandidateMeasurer& measurer);

}  // namespace urban_nav
