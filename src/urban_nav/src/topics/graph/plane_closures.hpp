// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "laser_mapper/parameters.hpp"
#include "laser_mapper/quality/plane_constraints.hpp"
#include "topics/graph/graph_run.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Finds constraints between poses of a relaxed graph from planes that the lasers measured in several passes, in each
/// of its maps. `ids`: the store's keys of run.sessions. A file beside the store is written and removed.
/// `cloud_half_length`: of the clouds that ICP closures rest on, m along the path; constraints have lost what an
/// accepted one tells from the same beams, since shared information counts once. Throws the errors of the store.
PlaneClosures findPlaneClosures(const laser_mapper::Parameters& parameters, urban_nav_store::Store& store,
                                const std::vector<urban_nav_store::SessionId>& ids, const GraphRun& run,
                                double cloud_half_length);

}  // namespace urban_nav
